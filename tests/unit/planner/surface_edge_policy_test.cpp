#include "core/planner/surface_edge_policy.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace nextview {
namespace {

/// A plate of 0.2 m in the plane z = 0, as scans have met it.
std::shared_ptr<const ScannedSurface> plate() {
  Scan scan;
  scan.origin = {0, 0, 1};
  for (int x = -50; x < 50; ++x)
    for (int y = -50; y < 50; ++y) scan.hits.emplace_back(float((x + 0.5) * 0.002), float((y + 0.5) * 0.002), 0.0f);
  auto surface = std::make_shared<ScannedSurface>(0.005);
  surface->add(scan, -Vector3::UnitZ(), 4e-6);
  return surface;
}

/// No ray meets anything, or each meets a wall of the plane z = 0.3 from above.
struct Wall : RayCaster {
  bool stands = false;
  void cast(const Vector3& origin, const Vector3& direction, std::vector<RayVoxel>& visited) const override {
    visited.clear();
    if (!stands || origin.z() < 0.3) return;
    RayVoxel wall;
    wall.measured = true;
    wall.probability = 0.9f;
    const Vector3 at = origin + direction * ((origin.z() - 0.305) / -direction.z());
    for (int axis = 0; axis < 3; ++axis) wall.lattice[std::size_t(axis)] = std::int16_t(std::floor(at[axis] / 0.01));
    visited = {wall};
  }
};

struct SurfaceEdges : ::testing::Test {
  SurfaceEdges() : known{OccupancyMap(region_of_interest(Vector3::Zero(), 1.0, 0.01), {})} { known.scanned = plate(); }
  std::vector<double> values() const {
    const PlanningState state{config, 1, 60.0, known, rays, bundle, nullptr, candidates, known.taken};
    const std::vector<std::size_t> available = {0, 1, 2, 3};
    return SurfaceEdgePolicy().values(state, available, {}).gains;
  }

  PlannerConfig config;
  Knowledge known;
  Wall rays;
  RayBundle bundle = RayBundle::regular(PinholeCamera::from_field_of_view(320, 240, 1.0));
  // From above; from beside, half of it in the image; away from it; from beyond the rays' reach.
  std::vector<View> candidates = {{look_at({0, 0.1, 0.6}, Vector3::Zero())},
                                  {look_at({0, 0.1, 0.6}, {0.28, 0, 0})},
                                  {look_at({0, 0.1, 0.6}, {0, 0.1, 2})},
                                  {look_at({0, 0.1, 2}, Vector3::Zero())}};
};

TEST_F(SurfaceEdges, AViewIsWorthTheEdgePointsThatItSees) {
  const std::vector<double> found = values();
  EXPECT_EQ(found[0], double(known.scanned->sparse_points(0.6).size())) << "all of them";
  EXPECT_GT(found[1], 0.1 * found[0]);
  EXPECT_LT(found[1], 0.9 * found[0]);
  EXPECT_EQ(found[2], 0.0);
  EXPECT_EQ(found[3], 0.0);
}

TEST_F(SurfaceEdges, WhatIsOccupiedHidesThem) {
  rays.stands = true;
  EXPECT_EQ(values()[0], 0.0);
}

TEST_F(SurfaceEdges, WithNothingScannedNothingIsSeen) {
  known.scanned = nullptr;
  EXPECT_EQ(values(), (std::vector<double>{0, 0, 0, 0}));
}

}  // namespace
}  // namespace nextview

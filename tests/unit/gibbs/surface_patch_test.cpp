#include "core/gibbs/surface_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nextview {
namespace {

constexpr double edge = 0.125;  // of a voxel [m]
const VoxelGrid cube{edge, {-4, -4, -4}, {9, 9, 9}};
const std::uint32_t middle = cube.index({4, 4, 4});  // its centre is at (0.5, 0.5, 0.5) edges

ForwardSensorModel sensor(double sigma) {
  ForwardSensorModel model;
  model.sigma = sigma;
  return model;
}

/// Ends of rays on a plane through a place [edges, from the middle voxel's centre], as seen from along `ray`.
struct Plane {
  Vector3 normal, through, ray;
  double noise = 0.0;  ///< of the range [m]
  unsigned seed = 1;
};

/// 25 x 25 rays, a quarter of an edge apart.
void add_plane(RangeMeasurements& measurements, const Plane& plane) {
  const Vector3 n = plane.normal.normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  const Vector3 centre = Vector3::Constant(0.5 * edge);
  std::mt19937 random(plane.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  measurements.origins.push_back(centre - 2.0 * plane.ray.normalized());
  const auto origin = static_cast<std::uint32_t>(measurements.origins.size() - 1);
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j) {
      const Vector3 at = centre + edge * (plane.through + 0.25 * i * u + 0.25 * j * v);
      const Vector3 way = (at - measurements.origins.back()).normalized();
      const Vector3 end = at + plane.noise * noise(random) * way;
      measurements.rays.push_back({end.cast<float>(), origin, 1, false});
    }
}

RayEnds ends_of(const RangeMeasurements& measurements, double sigma = 0.01) {
  return RayEnds(RayLists(cube, measurements, sensor(sigma)));
}
SurfacePatch patch_of(const RangeMeasurements& measurements, double sigma = 0.01) {
  return ends_of(measurements, sigma).patch(middle);
}

TEST(SurfacePatch, IsThePlaneThatRaysEndedOnNearAsWide) {
  for (const Vector3& normal : {Vector3(0, 0, 1), Vector3(1, 2, 3), Vector3(-1, 1, 0.2)})
    for (const double distance : {-0.4, 0.0, 0.3}) {
      const Vector3 n = normal.normalized(), ray = n + 0.5 * n.unitOrthogonal();
      RangeMeasurements measurements{5.0, {}, {}};
      add_plane(measurements, {n, distance * n, ray});
      const RayEnds ends = ends_of(measurements);
      for (const SurfacePatch& patch : {ends.patch(middle), ends.wide_patch(middle)}) {
        EXPECT_NEAR(patch.distance, distance, 0.02) << n.transpose();
        EXPECT_NEAR(patch.half, 0.5 * n.cwiseAbs().sum(), 0.01);
        EXPECT_LT(patch.roughness, 0.05f);
        EXPECT_NEAR(patch.incidence, n.dot(ray.normalized()), 0.05);
        EXPECT_EQ(patch.from_behind, 0.0f);
        EXPECT_GT(patch.ends, 20.0f);
      }
    }
}

TEST(SurfacePatch, AWideOneIsSteadierWhereRaysAreNoisy) {
  const double noise = 0.5 * edge, distance = 0.5;
  double near = 0.0, wide = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Vector3 n = Vector3(std::cos(i), std::sin(i), 1.5).normalized();
    RangeMeasurements measurements{5.0, {}, {}};
    add_plane(measurements, {n, distance * n, n, noise, unsigned(i)});
    const RayEnds ends = ends_of(measurements, noise);
    near += std::pow(ends.patch(middle).distance - distance, 2);
    wide += std::pow(ends.wide_patch(middle).distance - distance, 2);
  }
  EXPECT_LT(wide, near);
}

TEST(SurfacePatch, OfAThinWallHasBothItsSides) {
  const Vector3 n(0.2, 0.1, 1.0), unit = n.normalized();
  RangeMeasurements measurements{5.0, {}, {}};
  add_plane(measurements, {n, -0.2 * unit, n});
  add_plane(measurements, {n, 0.3 * unit, -n});
  SurfacePatch patch = patch_of(measurements);
  EXPECT_NEAR(patch.from_behind, 0.5, 0.1);
  if (patch.distance > patch.distance_from_behind) {  // which of both is in front is a matter of a few rays
    std::swap(patch.distance, patch.distance_from_behind);
    patch.distance *= -1.0f, patch.distance_from_behind *= -1.0f;
  }
  EXPECT_NEAR(patch.distance_from_behind - patch.distance, 0.5, 0.05);
}

TEST(SurfacePatch, TakesTheSensorsNoiseForWhatItIs) {
  const double noise = 0.3 * edge;
  const Vector3 n = Vector3(1, 0.5, 2).normalized();
  RangeMeasurements measurements{5.0, {}, {}};
  for (int i = 0; i < 8; ++i)
    add_plane(measurements, {n, 0.1 * n, n + 0.1 * i * n.unitOrthogonal(), noise, unsigned(i)});
  const SurfacePatch known = patch_of(measurements, noise), unknown = patch_of(measurements, 0.01 * edge);
  EXPECT_NEAR(known.distance, 0.1, 0.05);
  EXPECT_NEAR(known.half, 0.5 * n.cwiseAbs().sum(), 0.05);
  EXPECT_NEAR(unknown.roughness, 0.3, 0.06);
  EXPECT_LT(known.roughness, 0.12f);
}

TEST(SurfacePatch, OfASingleRayIsSquareToIt) {
  RangeMeasurements measurements{5.0, {Vector3(0.5 * edge, 0.5 * edge, -1.0)}, {}};
  measurements.rays.push_back({{float(0.5 * edge), float(0.5 * edge), float(0.75 * edge)}, 0, 3, false});
  const SurfacePatch patch = patch_of(measurements);
  EXPECT_NEAR(patch.distance, 0.25, 1e-4);
  EXPECT_NEAR(patch.half, 0.5, 1e-4);
  EXPECT_NEAR(patch.incidence, 1.0, 1e-4);
  EXPECT_NEAR(patch.ends, 3.0 * std::pow(1.0 - 0.25 * 0.25 / 2.25, 2), 1e-3);
}

TEST(SurfacePatch, IsNoneWhereNoRayEnds) {
  RangeMeasurements measurements{5.0, {Vector3(0.5 * edge, 0.5 * edge, -1.0)}, {}};
  measurements.rays.push_back({{float(0.5 * edge), float(0.5 * edge), float(0.5 * edge)}, 0, 1, true});   // it went on
  measurements.rays.push_back({{float(0.5 * edge), float(0.5 * edge), float(3.5 * edge)}, 0, 1, false});  // far behind
  const SurfacePatch patch = patch_of(measurements);
  EXPECT_EQ(patch.ends, 0.0f);
  EXPECT_EQ(patch.distance, 0.0f);
  EXPECT_EQ(patch.half, 0.0f);
  EXPECT_EQ(ends_of(measurements).wide_patch(middle).ends, 0.0f);
}

// Four ends near the border of a grid of two voxels, two of them just beyond it.
TEST(SurfacePatch, LooksNoFartherThanTheGrid) {
  const VoxelGrid two{edge, {0, 0, 0}, {2, 1, 1}};
  RangeMeasurements measurements{5.0, {Vector3(edge, 0.5 * edge, -1.0)}, {}};
  const auto add_end = [&](double x, double z) {
    measurements.rays.push_back({Vector3(edge * x, edge * 0.5, edge * z).cast<float>(), 0, 1, false});
  };
  add_end(0.9, 0.5), add_end(1.1, 0.5);    // in either voxel
  add_end(0.9, 1.25), add_end(1.1, -0.1);  // behind both, and in front of both
  const RayEnds ends(RayLists(two, measurements, sensor(0.01)));
  const auto share = [](double off) { return std::pow(1.0 - off * off / 2.25, 2); };
  EXPECT_NEAR(ends.patch(0).ends, share(0.4) + share(0.6), 1e-4);
  EXPECT_NEAR(ends.wide_patch(1).ends, 1.0 + std::exp(-0.5 / 1.44), 1e-4);
}

}  // namespace
}  // namespace nextview

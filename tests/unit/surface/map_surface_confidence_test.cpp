// What the surface of a map says of itself: how uncertain it is, and what was seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/surface/map_surface.hpp"
#include "tests/unit/map/closed_meshes.hpp"
#include "tests/unit/surface/made_maps.hpp"
#include "tests/unit/surface/surface_checks.hpp"

namespace nextview {
namespace {

using made_maps::edge;
using made_maps::free_space;
using made_maps::grid_of;
using made_maps::measured;
using surface_checks::closed;
using surface_checks::complete;

/// The uncertainties in the middle of layers of the given probabilities from z = 0 up, from the least to the largest,
/// in voxel edges; negative probabilities: not measured. Upper side only.
std::vector<float> uncertainties(const std::vector<float>& probabilities) {
  const VoxelGrid grid = grid_of({12, 12, int(probabilities.size())}, {0, 0, 0});
  std::vector<Voxel> voxels = free_space(grid);
  for (std::uint32_t v = 0; v < voxels.size(); ++v) {
    const float p = probabilities[std::size_t(grid.cell(v).z())];
    voxels[v] = p < 0.0f ? Voxel{} : measured(p);
  }
  const Surface surface = map_surface(grid, voxels);
  EXPECT_TRUE(complete(surface, edge));
  std::vector<float> result;
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
    const Eigen::Vector3f& p = surface.mesh.vertices[v];
    const bool middle = p.x() > 0.04f && p.x() < 0.08f && p.y() > 0.04f && p.y() < 0.08f;
    if (middle && p.z() > 0.015f) result.push_back(surface.uncertainty[v] / float(edge));
  }
  if (result.empty()) result.push_back(NAN);  // fails whatever is expected
  std::sort(result.begin(), result.end());
  return result;
}

TEST(MapSurfaceUncertainty, AQuarterOfAnEdgeWhereTheMapIsSure) {
  for (const auto& wall : {std::vector<float>{-1, -1, 1, 0, 0, 0}, {1, 1, 1, 0, 0, 0}, {0, 0, 1, 1, 0, 0}}) {
    const auto u = uncertainties(wall);
    EXPECT_NEAR(u.front(), 0.25, 0.005);
    EXPECT_NEAR(u.back(), 0.25, 0.005);
  }
}

TEST(MapSurfaceUncertainty, AboutAQuarterOfAnEdgeOnASureWallOneVoxelThin) {
  // From 2/3 in the middle to 0 half an edge off.
  const auto u = uncertainties({0, 0, 0, 1, 0, 0, 0});
  EXPECT_NEAR(u.front(), 0.1875, 0.005);
  EXPECT_NEAR(u.back(), 0.1875, 0.005);
}

TEST(MapSurfaceUncertainty, MoreWhereTheMapIsSoft) {
  // p falls by 0.4 per edge, so from 0.75 to 0.25 in 1.25 edges.
  EXPECT_NEAR(uncertainties({-1, -1, 1, 0.9f, 0.7f, 0.3f, 0.1f, 0}).back(), 0.625, 0.01);
  EXPECT_NEAR(uncertainties({-1, -1, 1, 0.9f, 0.7f, 0.3f, 0.1f, 0}).front(), 0.625, 0.01);
  double last = 0.2;
  for (const float soft : {0.0f, 0.1f, 0.2f, 0.3f, 0.4f}) {
    const double u = uncertainties({-1, -1, 1 - soft, 1 - soft, soft, soft, soft}).back();
    EXPECT_GT(u, last) << soft;
    EXPECT_NEAR(u, std::min(1.0, 0.25 / (1.0 - 2.0 * soft)), 0.01) << soft;
    last = u;
  }
  EXPECT_NEAR(uncertainties({-1, -1, 0.55f, 0.55f, 0.45f, 0.45f, 0.45f}).back(), 1.0, 1e-4) << "never over an edge";
}

TEST(MapSurfaceUncertainty, ASureSphereIsSureAllOver) {
  const VoxelGrid grid = closed_meshes::grid_around_origin();
  const Surface surface =
      map_surface(grid, made_maps::scanned(closed_meshes::sphere(Vector3(0.003, 0.001, 0.002), 0.09, 4), grid));
  std::vector<float> u = surface.uncertainty;
  std::sort(u.begin(), u.end());
  EXPECT_GT(u.front(), 0.15 * edge);
  EXPECT_LT(u[u.size() * 95 / 100], 0.4 * edge);
  EXPECT_LT(u.back(), 0.6 * edge);
}

constexpr double mapped_radius = 0.09;  // of the sphere below [m]

/// A sphere around the origin; `unseen(centre of the voxel)` takes voxels out of the scan.
template <class Unseen>
Surface partly_seen(Unseen unseen) {
  const VoxelGrid grid = closed_meshes::grid_around_origin();
  auto voxels = made_maps::scanned(closed_meshes::sphere(Vector3::Zero(), mapped_radius, 5), grid);
  for (std::uint32_t v = 0; v < voxels.size(); ++v)
    if (unseen(grid.centre(v))) voxels[v] = Voxel{};
  Surface surface = map_surface(grid, voxels);
  EXPECT_TRUE(closed(surface.mesh));
  EXPECT_TRUE(complete(surface, edge));
  return surface;
}

TEST(MapSurfaceSeen, AHalfThatNoViewHasSeenIsClosedAndMarked) {
  const Surface surface = partly_seen([](const Vector3& p) { return p.x() < 0.0; });
  int seen = 0, unseen = 0;
  for (std::size_t v = 0; v < surface.seen.size(); ++v) {
    const Vector3 p = surface.mesh.vertices[v].cast<double>();
    if (p.x() > 1.5 * edge) {
      ++seen;
      ASSERT_EQ(surface.seen[v], 1) << p.transpose();
      ASSERT_NEAR(p.norm(), mapped_radius, edge);
    } else if (p.x() < -0.5 * edge || std::hypot(p.y(), p.z()) > mapped_radius + 1.5 * edge) {
      ++unseen;
      ASSERT_EQ(surface.seen[v], 0) << p.transpose();
    }
  }
  EXPECT_GT(seen, 500);
  EXPECT_GT(unseen, 500);
}

TEST(MapSurfaceSeen, ACapOnTheObjectThatNoRayHasMetIsClosedAndMarked) {
  const auto in_cap = [](const Vector3& p) { return p.z() > 0.05 && p.norm() < mapped_radius + edge; };
  const Surface surface = partly_seen(in_cap);
  int cap = 0;
  for (std::size_t v = 0; v < surface.seen.size(); ++v) {
    const Vector3 p = surface.mesh.vertices[v].cast<double>();
    if (p.z() > 0.05 + 0.3 * edge) {
      ++cap;
      ASSERT_EQ(surface.seen[v], 0) << p.transpose();
      ASSERT_NEAR(p.norm(), mapped_radius, 2.0 * edge) << "closed near where it must be: in front is free space";
    } else if (p.z() < 0.05 - 0.3 * edge) {
      ASSERT_EQ(surface.seen[v], 1) << p.transpose();
    }
  }
  EXPECT_GT(cap, 100);
}

TEST(MapSurfaceSeen, ASingleUnmeasuredVoxelInASeenWallDoesNotTearItsNeighbours) {
  const VoxelGrid grid = grid_of({11, 11, 6}, {0, 0, 0});
  std::vector<Voxel> voxels = free_space(grid);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 11; ++x)
      for (int z = 0; z < 3; ++z) voxels[grid.index({x, y, z})] = z == 2 ? measured(1.0f) : Voxel{};
  voxels[grid.index({5, 5, 2})] = Voxel{};
  const Surface surface = map_surface(grid, voxels);
  int in_it = 0, around = 0;
  for (std::size_t v = 0; v < surface.seen.size(); ++v) {
    const Vector3 off = surface.mesh.vertices[v].cast<double>() - grid.centre(grid.index({5, 5, 2}));
    if (std::abs(off.z()) > 0.1 * edge) continue;
    if (off.norm() < 0.1 * edge) {
      EXPECT_EQ(surface.seen[v], 0);
      ++in_it;
    }
    if (off.norm() > 1.1 * edge && off.head<2>().cwiseAbs().maxCoeff() < 4.2 * edge) {
      EXPECT_EQ(surface.seen[v], 1) << off.transpose();
      ++around;
    }
  }
  EXPECT_GT(in_it, 0);
  EXPECT_GT(around, 20);
}

TEST(MapSurfaceSeen, ASingleMeasuredVoxelInAWallNoViewHasSeenIsSeenAlone) {
  const VoxelGrid grid = grid_of({11, 11, 6}, {0, 0, 0});
  std::vector<Voxel> voxels = free_space(grid);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 11; ++x)
      for (int z = 0; z < 3; ++z) voxels[grid.index({x, y, z})] = Voxel{};
  voxels[grid.index({5, 5, 2})] = measured(1.0f);
  const Surface surface = map_surface(grid, voxels);
  int seen = 0;
  for (std::size_t v = 0; v < surface.seen.size(); ++v) {
    const double off = (surface.mesh.vertices[v].cast<double>() - grid.centre(grid.index({5, 5, 2}))).norm();
    seen += surface.seen[v];
    if (off > 0.6 * edge) {
      EXPECT_EQ(surface.seen[v], 0) << off << " m away: three of the four voxels around were not measured";
    }
  }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace nextview

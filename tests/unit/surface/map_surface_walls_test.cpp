// Where the surface of a map runs along walls and thin sheets.
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
using surface_checks::crossings;

/// A map with layers of the given probabilities from z = 0 up, the same over the whole grid; negative: not measured.
std::pair<VoxelGrid, std::vector<Voxel>> layers(const std::vector<float>& probabilities) {
  const VoxelGrid grid = grid_of({12, 12, int(probabilities.size())}, {0, 0, 0});
  std::vector<Voxel> voxels = free_space(grid);
  for (std::uint32_t v = 0; v < voxels.size(); ++v) {
    const float p = probabilities[std::size_t(grid.cell(v).z())];
    voxels[v] = p < 0.0f ? Voxel{} : measured(p);
  }
  return {grid, voxels};
}

const Vector3 in_the_middle(0.0567, 0.0571, 0.0);

/// Where the surface over the layers runs, in the middle of the grid [voxel edges].
double height(const std::vector<float>& probabilities) {
  const auto [grid, voxels] = layers(probabilities);
  const auto hits = crossings(map_surface(grid, voxels).mesh, in_the_middle, Vector3::UnitZ());
  return hits.out.empty() ? NAN : *std::max_element(hits.out.begin(), hits.out.end()) / edge;
}

TEST(MapSurfaceWalls, ASureWallRunsThroughTheMiddleOfItsOutermostVoxels) {
  EXPECT_NEAR(height({-1, -1, 1, 0, 0, 0}), 2.5, 0.002);
  EXPECT_NEAR(height({1, 1, 1, 0, 0, 0}), 2.5, 0.002);
}

TEST(MapSurfaceWalls, ProbabilitiesMoveTheSurfaceMonotonically) {
  double last = 0.0;
  for (int step = 0; step <= 50; ++step) {
    const float p = 0.5f + 0.01f * float(step);
    const double at = height({-1, -1, p, 0, 0, 0});
    EXPECT_GT(at, step == 0 ? 1.9 : last) << p;
    EXPECT_NEAR(at, 3.0 - 0.5 / p, 0.005) << "a straight line from 0 in front of the voxel to p behind it";
    last = at;
  }
  for (int step = 1; step < 50; ++step) {
    const float q = 0.01f * float(step);
    const double at = height({-1, -1, 1, q, 0, 0});
    EXPECT_GT(at, last) << q;
    EXPECT_LT(at, 3.0 + 0.006) << q;
    last = at;
  }
}

TEST(MapSurfaceWalls, SheetsOneVoxelThinAreClosedShellsAQuarterOfAVoxelThick) {
  for (const float p : {1.0f, 0.8f}) {
    const VoxelGrid grid = grid_of({12, 12, 7}, {0, 0, 0});
    std::vector<Voxel> voxels = free_space(grid);
    for (int y = 1; y < 11; ++y)
      for (int x = 1; x < 11; ++x) voxels[grid.index({x, y, 3})] = measured(p);
    const Surface surface = map_surface(grid, voxels);
    ASSERT_TRUE(closed(surface.mesh));
    EXPECT_EQ(surface_checks::piece_count(surface.mesh), 1u);
    for (int y = 1; y < 11; ++y)
      for (int x = 1; x < 11; ++x) {
        const Vector3 from(edge * (x + 0.507), edge * (y + 0.511), 0.0);
        const auto hits = crossings(surface.mesh, from, Vector3::UnitZ());
        ASSERT_EQ(hits.in.size(), 1u) << x << " " << y;
        ASSERT_EQ(hits.out.size(), 1u) << x << " " << y;
        EXPECT_NEAR(0.5 * (hits.in[0] + hits.out[0]), 3.5 * edge, 0.01 * edge);
        if (x == 5 && y == 5) {
          EXPECT_NEAR(hits.out[0] - hits.in[0], 0.25 * edge, 0.02 * edge);
        }
      }
  }
}

TEST(MapSurfaceWalls, TiltedSheetsHaveNoHoles) {
  for (int n = 0; n < 10; ++n) {
    TriangleMesh sheet;
    sheet.vertices = {{-0.08f, -0.07f, 0.0f}, {0.08f, -0.07f, 0.0f}, {0.08f, 0.07f, 0.0f}, {-0.08f, 0.07f, 0.0f}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    const double angle = 0.3 * n;
    closed_meshes::turn(sheet, angle);
    const VoxelGrid grid = grid_of({24, 24, 24}, {-12, -12, -12});
    const auto touch = ground_truth(sheet, grid).touch;
    std::vector<Voxel> voxels = free_space(grid);
    for (std::size_t v = 0; v < voxels.size(); ++v)
      if (touch[v]) voxels[v] = measured(1.0f);
    const Surface surface = map_surface(grid, voxels);
    ASSERT_TRUE(closed(surface.mesh));
    const Eigen::AngleAxisd rotation(angle, Vector3(0.4, -0.3, 0.8).normalized());
    int holes = 0;
    for (double y = -0.0601; y < 0.06; y += 0.0067)
      for (double x = -0.0703; x < 0.07; x += 0.0071) {
        const auto hits = crossings(surface.mesh, rotation * Vector3(x, y, -0.1), rotation * Vector3::UnitZ());
        ASSERT_EQ(hits.in.size(), hits.out.size());
        holes += hits.in.empty();
      }
    EXPECT_EQ(holes, 0) << "turned by " << angle;
  }
}

}  // namespace
}  // namespace nextview

// Maps of every kind: what may never happen, and the odd ones.
#include "core/surface/map_surface.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

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
using surface_checks::piece_count;
using surface_checks::signed_volume;

Eigen::AlignedBox3d box_of(const TriangleMesh& mesh) { return mesh.bounding_box(); }

void fill(const VoxelGrid& grid, std::vector<Voxel>& voxels, const Eigen::Vector3i& from, const Eigen::Vector3i& to,
          const Voxel& voxel) {
  for (int z = from.z(); z < to.z(); ++z)
    for (int y = from.y(); y < to.y(); ++y)
      for (int x = from.x(); x < to.x(); ++x) voxels[grid.index({x, y, z})] = voxel;
}

TEST(MapSurface, RandomMapsGiveClosedSurfaces) {
  std::mt19937 random(7);
  int made = 0;
  for (int n = 0; n < 600; ++n) {
    const VoxelGrid grid = grid_of({1 + n % 7, 1 + n / 7 % 6, 1 + n / 42 % 5});
    const auto voxels = n % 3 == 0 ? made_maps::random_blobs(random, grid)
                                   : made_maps::random_voxels(random, grid, 0.1 * (n % 4), 0.1 + 0.2 * (n % 5));
    const Surface surface = map_surface(grid, voxels);
    ASSERT_TRUE(complete(surface, edge)) << "map " << n;
    if (surface.empty()) continue;
    ++made;
    ASSERT_TRUE(closed(surface.mesh)) << "map " << n;
    const Eigen::AlignedBox3d region(grid.lower(), grid.upper());
    ASSERT_TRUE(region.contains(box_of(surface.mesh))) << "map " << n;
  }
  EXPECT_GT(made, 400);
}

TEST(MapSurface, RandomMapsFarFromTheOriginGiveEveryVertexOnce) {
  std::mt19937 random(8);
  for (int n = 0; n < 200; ++n) {
    const VoxelGrid grid = grid_of({7, 6, 5}, {8000, -8000, 8000});  // 80 m off: floats have 8 micrometres there
    const Surface surface = map_surface(grid, made_maps::random_voxels(random, grid, 0.1, 0.5));
    ASSERT_TRUE(surface.empty() || closed(surface.mesh)) << "map " << n;
    std::set<std::array<float, 3>> places;
    for (const auto& v : surface.mesh.vertices) places.insert({v.x(), v.y(), v.z()});
    ASSERT_EQ(places.size(), surface.mesh.vertices.size()) << "map " << n;
  }
}

TEST(MapSurface, NothingToShowSaysWhy) {
  const VoxelGrid grid = grid_of({6, 5, 4});
  const std::vector<Voxel> unknown(grid.voxel_count());
  for (const auto& voxels : {unknown, free_space(grid)}) {
    const Surface surface = map_surface(grid, voxels);
    EXPECT_TRUE(surface.empty());
    EXPECT_FALSE(surface.why_empty.empty());
  }
  EXPECT_NE(map_surface(grid, unknown).why_empty, map_surface(grid, free_space(grid)).why_empty);
  std::vector<Voxel> undecided(grid.voxel_count(), Voxel{.probability = 0.5f, .measured = true});
  EXPECT_EQ(map_surface(grid, VoxelBricks(grid.size, undecided), 0.5).why_empty, "no voxel is occupied");
  EXPECT_TRUE(complete(map_surface(VoxelGrid{}, std::vector<Voxel>()), edge)) << "a grid without voxels";
}

TEST(MapSurface, RefusesVoxelsThatAreNotTheGrids) {
  const VoxelGrid grid = grid_of({6, 5, 4});
  EXPECT_THROW(map_surface(grid, std::vector<Voxel>(119)), std::invalid_argument);
  EXPECT_THROW(map_surface(grid, std::vector<Voxel>(121)), std::invalid_argument);
}

TEST(MapSurface, OneOccupiedVoxelIsClosedAroundItsCentre) {
  for (const float p : {0.5f, 0.6f, 1.0f}) {
    const VoxelGrid grid = grid_of({5, 6, 7});
    std::vector<Voxel> voxels = free_space(grid);
    const std::uint32_t at = grid.index({2, 3, 4});
    voxels[at] = measured(p);
    const Surface surface = map_surface(grid, voxels);
    ASSERT_TRUE(closed(surface.mesh)) << p;
    EXPECT_TRUE(complete(surface, edge));
    const Eigen::AlignedBox3d box = box_of(surface.mesh);
    EXPECT_LT((box.center() - grid.centre(at)).norm(), 1e-6);
    EXPECT_LT(box.sizes().maxCoeff(), edge);
    EXPECT_GT(signed_volume(surface.mesh), 0.0);
    EXPECT_EQ(std::count(surface.seen.begin(), surface.seen.end(), 1), std::ptrdiff_t(surface.seen.size()));
  }
}

TEST(MapSurface, OneUnmeasuredVoxelInFreeSpaceIsNothing) {
  const VoxelGrid grid = grid_of({9, 9, 9});
  std::vector<Voxel> voxels = free_space(grid);
  voxels[grid.index({2, 2, 2})] = Voxel{};
  fill(grid, voxels, {5, 5, 5}, {8, 8, 8}, measured(1.0f));
  const Surface surface = map_surface(grid, voxels);
  EXPECT_TRUE(closed(surface.mesh));
  EXPECT_EQ(piece_count(surface.mesh), 1u);
  EXPECT_GT(box_of(surface.mesh).min().x(), grid.centre(grid.index({5, 5, 5})).x() - 0.01 * edge);
}

TEST(MapSurface, TwoSeparateSolidsAreTwoPieces) {
  const VoxelGrid grid = grid_of({12, 7, 7});
  std::vector<Voxel> voxels = free_space(grid);
  fill(grid, voxels, {1, 1, 1}, {5, 6, 6}, measured(1.0f));
  fill(grid, voxels, {6, 1, 1}, {11, 6, 6}, measured(1.0f));  // one free voxel between them
  const Surface surface = map_surface(grid, voxels);
  EXPECT_TRUE(closed(surface.mesh));
  EXPECT_EQ(piece_count(surface.mesh), 2u);
  // Between the middles of the outermost voxels, without a bevel along each of the 92 voxels of edges: legs of half a
  // voxel at most.
  EXPECT_LE(signed_volume(surface.mesh), (3 * 4 * 4 + 4 * 4 * 4) * 1e-6);
  EXPECT_GE(signed_volume(surface.mesh), (3 * 4 * 4 + 4 * 4 * 4 - 92.0 / 8.0) * 1e-6);
}

TEST(MapSurface, ASolidThatReachesTheRegionsBorderIsClosedThere) {
  const VoxelGrid grid = grid_of({8, 8, 8});
  std::vector<Voxel> voxels = free_space(grid);
  fill(grid, voxels, {0, 0, 0}, {8, 8, 3}, measured(1.0f));
  const Surface floor = map_surface(grid, voxels);
  EXPECT_TRUE(closed(floor.mesh));
  EXPECT_TRUE(Eigen::AlignedBox3d(grid.lower(), grid.upper()).contains(box_of(floor.mesh)));
  const std::vector<Voxel> full(grid.voxel_count(), measured(1.0f));
  EXPECT_TRUE(closed(map_surface(grid, full).mesh));
}

TEST(MapSurface, CavitiesThatNoCameraSeesAreClosedAndPocketsThatReachTheBorderStay) {
  const VoxelGrid grid = grid_of({11, 11, 11});
  std::vector<Voxel> voxels = free_space(grid);
  fill(grid, voxels, {1, 1, 1}, {10, 10, 10}, measured(1.0f));
  const double full = signed_volume(map_surface(grid, voxels).mesh);
  fill(grid, voxels, {4, 4, 4}, {7, 7, 7}, measured(0.0f));
  const Surface cavity = map_surface(grid, voxels);
  EXPECT_EQ(piece_count(cavity.mesh), 1u);
  EXPECT_NEAR(signed_volume(cavity.mesh), full, 1e-9);
  fill(grid, voxels, {7, 4, 4}, {10, 7, 7}, measured(0.0f));
  const Surface opened = map_surface(grid, voxels);
  EXPECT_TRUE(closed(opened.mesh));
  EXPECT_LT(signed_volume(opened.mesh), full - 60e-6);
}

// 3 x 3 x 3 free voxels in the middle; the voxels around are all but free, as near below the threshold as they may be.
TEST(MapSurface, VoxelsJustBelowTheThresholdAreFree) {
  for (const float p : {0.4f, 0.495f, 0.4985f, 0.4992f, 0.4999f}) {
    const VoxelGrid grid = grid_of({11, 11, 11});
    std::vector<Voxel> voxels(grid.voxel_count(), measured(p));
    fill(grid, voxels, {4, 4, 4}, {7, 7, 7}, measured(0.9f));
    const Surface surface = map_surface(grid, voxels);
    ASSERT_TRUE(complete(surface, edge)) << p;
    ASSERT_TRUE(closed(surface.mesh)) << p;
    EXPECT_LT(box_of(surface.mesh).sizes().maxCoeff(), 5.0 * edge) << p;
  }
}

TEST(MapSurface, ProbabilitiesThatAreNoNumbersAreRefused) {
  const VoxelGrid grid = grid_of({9, 9, 9});
  std::vector<Voxel> voxels(grid.voxel_count(), measured(0.1f));
  fill(grid, voxels, {3, 3, 3}, {6, 6, 6}, measured(0.9f));
  EXPECT_TRUE(complete(map_surface(grid, voxels), edge));
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float p : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity})
    for (const Eigen::Vector3i& cell : {Eigen::Vector3i(4, 4, 4), {0, 8, 3}}) {
      std::vector<Voxel> wrong = voxels;
      wrong[grid.index(cell)] = measured(p);
      EXPECT_THROW(map_surface(grid, wrong), std::invalid_argument) << p << " at " << cell.transpose();
    }
}

TEST(MapSurface, SameBytesOnOneAndTwoThreads) {
  const VoxelGrid grid = closed_meshes::grid_around_origin();
  const auto voxels = made_maps::scanned(closed_meshes::sphere(Vector3(0.003, 0.001, 0.002), 0.09, 4), grid);
  const auto make = [&] { return map_surface(grid, voxels); };
  const Surface one = surface_checks::with_threads(1, make), two = surface_checks::with_threads(2, make);
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.uncertainty, two.uncertainty);
  EXPECT_EQ(one.seen, two.seen);
}

}  // namespace
}  // namespace nextview

#include "core/map/octree_bytes.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

/// A cube of free voxels, 64 along its edges.
OccupancyMap cube_of_free_space() {
  OccupancyMap map(VoxelGrid{0.01, Eigen::Vector3i(-64, 0, 64), Eigen::Vector3i::Constant(64)});
  for (std::uint32_t v = 0; v < map.grid().voxel_count(); ++v) map.set_log_odds(v, -0.4f);
  return map;
}

TEST(OctreeBytes, FreeSpaceIsOneLeafAndTakesTheMemoryOfOne) {
  constexpr std::size_t depth = 10;  // of a leaf of 64 voxels
  const OctreeBytes full = octree_bytes(cube_of_free_space(), false), binary = octree_bytes(cube_of_free_space(), true);
  EXPECT_EQ(full.nodes, depth + 1);
  EXPECT_EQ(full.bytes.size(), 5 * (depth + 1)) << "a float and a byte each";
  EXPECT_EQ(binary.nodes, depth + 1);
  EXPECT_EQ(binary.bytes.size(), 2 * depth) << "a leaf stands in its parent's bytes";
  EXPECT_LT(full.bytes.capacity(), 1000u) << "while it was made it was no larger";
}

TEST(OctreeBytes, AVoxelThatDiffersOpensTheLeavesAroundIt) {
  OccupancyMap map = cube_of_free_space();
  map.set_log_odds(map.grid().index({1, 2, 3}), 0.8f);
  EXPECT_EQ(octree_bytes(map, false).nodes, 11u + 6 * 8) << "eight children on each of six levels";
}

TEST(OctreeBytes, OfNothingThereAreNone) {
  const OctreeBytes none = octree_bytes(OccupancyMap(VoxelGrid{0.01, {-3, 5, 7}, {9, 10, 11}}), false);
  EXPECT_EQ(none.nodes, 0u);
  EXPECT_TRUE(none.bytes.empty());
}

}  // namespace
}  // namespace nextview

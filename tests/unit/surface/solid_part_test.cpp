#include <gtest/gtest.h>

#include "core/surface/solid_voxels.hpp"
#include "tests/unit/surface/made_maps.hpp"

namespace nextview {
namespace {

using made_maps::grid_of;
using made_maps::measured;

TEST(SolidPart, GrowsWithWhatIsOccupiedAndNotWithTheMap) {
  for (const int edge : {40, 60}) {
    const VoxelGrid grid = grid_of({edge, edge, edge});
    std::vector<Voxel> voxels(grid.voxel_count());
    for (int i = 0; i < 8; ++i) voxels[grid.index({20 + i, 21, 22})] = measured(0.9f);
    const auto part = solid_part(grid, VoxelBricks(grid.size, voxels), DecidedVoxels());
    ASSERT_TRUE(part);
    EXPECT_EQ(part->grid.size, Eigen::Vector3i(8 + 8, 1 + 8, 1 + 8)) << "a quarter and two more on each side";
    EXPECT_EQ(part->grid.first, grid.first + part->offset);
  }
}

/// A pocket larger than what of the free space around is in the part: that goes on beyond it.
TEST(SolidPart, WhatIsFreeBeyondThePartCountsWithWhatIsFreeInIt) {
  constexpr int edge = 80, middle = 40, wall = 20;
  const VoxelGrid grid = grid_of({edge, edge, edge});
  std::vector<Voxel> voxels(grid.voxel_count());
  for (std::uint32_t v = 0; v < voxels.size(); ++v)
    if (const int away = (grid.cell(v) - Eigen::Vector3i::Constant(middle)).cwiseAbs().maxCoeff(); away <= wall)
      voxels[v] = measured(away == wall ? 0.9f : 0.1f);
  const auto part = solid_part(grid, VoxelBricks(grid.size, voxels), DecidedVoxels());
  ASSERT_TRUE(part);
  ASSERT_LT(part->grid.voxel_count(), grid.voxel_count());
  const Eigen::Vector3i in_part = Eigen::Vector3i::Constant(middle) - part->offset;
  EXPECT_EQ(part->solid[part->grid.index(in_part)], 1.0f) << "the space around is larger";
}

}  // namespace
}  // namespace nextview

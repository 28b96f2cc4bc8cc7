#include "ui/workbench/laid_out_voxels.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace nextview {
namespace {

TEST(LaidOutVoxels, AreThoseOfTheBricksForEachThreadThatLooks) {
  VoxelBricks bricks({19, 8, 5});
  const std::size_t place = bricks.place(17, 2, 3);
  bricks.change_brick_of(place).set_measured(place % VoxelBricks::brick_voxels, 0.8f, VoxelClass::occupied);
  const LaidOutVoxels voxels(bricks), copy = voxels;
  const std::vector<Voxel>* seen[2] = {};
  {
    const std::jthread one([&] { seen[0] = &*voxels; }), other([&] { seen[1] = &*copy; });
  }
  EXPECT_EQ(seen[0], seen[1]) << "copies share them";
  ASSERT_EQ(voxels->size(), bricks.size());
  for (std::size_t v = 0; v < bricks.size(); ++v) {
    EXPECT_EQ((*voxels)[v].measured, bricks[v].measured) << v;
    EXPECT_EQ((*voxels)[v].log_odds, bricks[v].log_odds) << v;
  }
  EXPECT_TRUE(voxels);
  EXPECT_FALSE(LaidOutVoxels());
}

}  // namespace
}  // namespace nextview

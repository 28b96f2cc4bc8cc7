#include "ui/workbench/chosen_voxels.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

TEST(ChosenColouring, IsByProbabilityWhereThereIsNoMapToDifferFrom) {
  SessionSnapshot snapshot;
  LayerChoice choice;
  choice.colouring = VoxelColouring::by_difference;
  EXPECT_EQ(chosen_colouring(snapshot, choice), VoxelColouring::by_probability);
  EXPECT_TRUE(chosen_values(snapshot, choice).empty());
  choice.colouring = VoxelColouring::by_entropy;
  EXPECT_EQ(chosen_colouring(snapshot, choice), VoxelColouring::by_entropy);
  snapshot.gibbs = std::make_shared<const GibbsMap>();
  choice.colouring = VoxelColouring::by_difference;
  EXPECT_EQ(chosen_colouring(snapshot, choice), VoxelColouring::by_difference) << "it comes back";
}

}  // namespace
}  // namespace nextview

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

TEST(ChosenColouring, NeedsNoTruthWhereThereIsNone) {
  SessionSnapshot snapshot;
  LayerChoice choice;
  choice.colouring = VoxelColouring::by_error;
  choice.cloud_colouring = CloudColouring::by_distance;
  EXPECT_EQ(chosen_colouring(snapshot, choice), VoxelColouring::by_class);
  EXPECT_EQ(chosen_cloud_colouring(snapshot, choice), CloudColouring::single);
  EXPECT_EQ(chosen_surface_colouring(snapshot, choice), SurfaceColouring::by_uncertainty);
  choice.cloud_colouring = CloudColouring::by_height;
  EXPECT_EQ(chosen_cloud_colouring(snapshot, choice), CloudColouring::by_height);
  snapshot.truth = std::make_shared<const GroundTruth>();
  choice.cloud_colouring = CloudColouring::by_distance;
  EXPECT_EQ(chosen_colouring(snapshot, choice), VoxelColouring::by_error) << "it comes back";
  EXPECT_EQ(chosen_cloud_colouring(snapshot, choice), CloudColouring::by_distance);
  EXPECT_EQ(chosen_surface_colouring(snapshot, choice), SurfaceColouring::by_deviation);
}

}  // namespace
}  // namespace nextview

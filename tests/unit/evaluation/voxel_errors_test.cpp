#include "core/evaluation/voxel_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/evaluation/map_quality.hpp"
#include "tests/unit/map/closed_meshes.hpp"

namespace nextview {
namespace {

TEST(VoxelErrors, ByHand) {
  GroundTruth truth;
  truth.grid.size = {5, 1, 1};
  truth.touch = BitMask(std::vector<std::uint8_t>{0, 1, 1, 0, 0});
  truth.centre = BitMask(std::vector<std::uint8_t>{0, 0, 1, 1, 0});  // the fourth is hidden
  const std::vector<float> p = {0.25f, 0.75f, 0.5f, 0.9f, 0.0f};
  const auto touch = voxel_errors(p, truth, TruthConvention::touch);
  const auto centre = voxel_errors(p, truth, TruthConvention::centre);
  EXPECT_EQ(touch[0], 0.25f);
  EXPECT_EQ(touch[1], 0.25f);
  EXPECT_EQ(centre[1], 0.75f);
  EXPECT_EQ(touch[2], 0.5f);
  EXPECT_TRUE(std::isnan(touch[3]) && std::isnan(centre[3]));
  EXPECT_EQ(touch[4], 0.0f);
  const std::vector<std::uint8_t> counted = {1, 0, 1, 1, 0};
  const auto masked = voxel_errors(p, truth, TruthConvention::touch, counted);
  EXPECT_EQ(masked[0], 0.25f);
  EXPECT_EQ(masked[2], 0.5f);
  for (const int v : {1, 3, 4}) EXPECT_TRUE(std::isnan(masked[v])) << v;
}

// Their squares average to the Brier score of the same set.
TEST(VoxelErrors, MakeTheBrierScore) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.6, 0.02);
  const GroundTruth truth = ground_truth(closed_meshes::sphere(Vector3::Zero(), 0.2, 4), grid);
  std::vector<float> p(grid.voxel_count());
  std::vector<std::uint8_t> visited(grid.voxel_count());
  for (std::size_t v = 0; v < p.size(); ++v) {
    p[v] = float(v * 2654435761u % 1000) / 1000.0f;
    visited[v] = v % 3 != 0;
  }
  for (const TruthConvention convention : {TruthConvention::touch, TruthConvention::centre})
    for (const bool masked : {false, true}) {
      const auto errors = voxel_errors(p, truth, convention, masked ? visited : std::vector<std::uint8_t>{});
      double sum = 0.0;
      std::size_t count = 0;
      for (const float e : errors)
        if (!std::isnan(e)) sum += double(e) * e, ++count;
      const MapQuality quality =
          map_quality(p, truth, convention, masked ? ScoredSet::visited : ScoredSet::region, visited);
      EXPECT_EQ(count, quality.voxels);
      EXPECT_LT(count, p.size());
      EXPECT_NEAR(sum / double(count), quality.brier, 1e-6);
    }
}

TEST(VoxelErrors, RefuseOtherLengths) {
  GroundTruth truth;
  truth.grid.size = {2, 1, 1};
  truth.touch = truth.centre = BitMask(2);
  const std::vector<float> one(1), two(2);
  const std::vector<std::uint8_t> mask(1);
  EXPECT_THROW(voxel_errors(one, truth, TruthConvention::touch), std::invalid_argument);
  EXPECT_THROW(voxel_errors(two, truth, TruthConvention::touch, mask), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

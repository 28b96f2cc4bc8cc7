#include "ui/layers/ray_segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace nextview {
namespace {

ScoreExplanation explanation(std::size_t rays) {
  ScoreExplanation e;
  e.rays.resize(rays);
  for (std::size_t i = 0; i < rays; ++i) {
    e.rays[i].direction = Vector3::UnitX();
    e.rays[i].voxels.push_back({{10, 0, 0}});
    e.rays[i].contribution = 0.001;
  }
  return e;
}

TEST(RaySegments, AreThoseThatContributeMostOfEachStretch) {
  ScoreExplanation e = explanation(15'200);
  e.rays[7001].contribution = 3.0;
  e.rays[7002].contribution = 2.0;
  e.rays[15'199].contribution = 1.0;
  const auto segments = ray_segments(e, Vector3::Zero(), 0.01, 60);
  ASSERT_EQ(segments.size(), 60u);
  EXPECT_EQ(std::ranges::count(segments, 7001u, &RaySegment::index), 1);
  EXPECT_EQ(std::ranges::count(segments, 7002u, &RaySegment::index), 0) << "its neighbour stands for it";
  EXPECT_EQ(segments.back().index, 15'199u);
  EXPECT_EQ(std::ranges::max(segments, {}, &RaySegment::value).value, 3.0) << "as dark as the picture's darkest";
  EXPECT_TRUE(std::ranges::is_sorted(segments, {}, &RaySegment::index));
  EXPECT_NEAR(segments[0].to.x(), 0.105, 1e-12) << "the last voxel's middle";
}

TEST(RaySegments, OfFewRaysAreAllThatMeetAVoxel) {
  ScoreExplanation e = explanation(5);
  e.rays[2].voxels.clear();
  EXPECT_EQ(ray_segments(e, Vector3::Zero(), 0.01, 60).size(), 4u);
  EXPECT_TRUE(ray_segments({}, Vector3::Zero(), 0.01, 60).empty());
}

}  // namespace
}  // namespace nextview

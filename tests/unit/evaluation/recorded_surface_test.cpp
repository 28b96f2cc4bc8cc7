#include "core/evaluation/recorded_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace nextview {
namespace {

constexpr double d_reg = 0.01;

/// Frames that see some of a plane each, with noise.
std::vector<PointCloud> frames_of_a_plane() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> in_window(0.0f, 0.1f);
  std::normal_distribution<float> noise(0.0f, 0.001f);
  std::vector<PointCloud> frames(6);
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (int i = 0; i < 3000; ++i)
      frames[f].emplace_back(0.04f * float(f) + in_window(random), in_window(random), noise(random));
  return frames;
}

RecordedSurface surface_of(const std::vector<PointCloud>& frames) {
  return {frames.size(), [&](std::size_t f) { return frames[f]; }, d_reg};
}

/// What RecordedSurface says it computes, point by point: the oracle looks at all points, not at thinned ones, so it
/// may see a little more.
double brute_force_coverage(const RecordedSurface& surface, const std::vector<PointCloud>& frames,
                            std::span<const std::size_t> taken, double reach) {
  std::size_t seen = 0;
  for (const Eigen::Vector3f& sample : surface.samples())
    seen += std::ranges::any_of(taken, [&](std::size_t f) {
      return std::ranges::any_of(frames[f], [&](const auto& p) { return (p - sample).norm() <= reach; });
    });
  return double(seen) / double(surface.samples().size());
}

TEST(RecordedSurface, CoverageIsThatOfEachPointLookedAt) {
  const auto frames = frames_of_a_plane();
  const RecordedSurface surface = surface_of(frames);
  const std::vector<std::size_t> order = {4, 0, 2};
  const std::vector<double> coverage = surface.coverage(order);
  ASSERT_EQ(coverage.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::span<const std::size_t> taken(order.data(), k + 1);
    EXPECT_LE(coverage[k], brute_force_coverage(surface, frames, taken, d_reg) + 1e-12);
    EXPECT_GE(coverage[k], brute_force_coverage(surface, frames, taken, 0.13 * d_reg));
  }
}

TEST(RecordedSurface, WhatFramesCoverDoesNotDependOnWhatWasAskedBefore) {
  const RecordedSurface surface = surface_of(frames_of_a_plane());
  const std::vector<std::vector<std::size_t>> asked = {{4},    {4, 0}, {4, 0, 2, 3}, {4, 0, 2, 3},
                                                       {4, 0}, {4, 1}, {0, 4, 1},    {5}};
  for (const auto& frames : asked) EXPECT_EQ(surface.covered_by(frames), surface.coverage(frames).back());
  EXPECT_EQ(surface.covered_by({}), 0.0);
}

TEST(RecordedSurface, AllFramesShowAllOfItInAnyOrder) {
  const RecordedSurface surface = surface_of(frames_of_a_plane());
  const CoverageByOrder orders = surface.compare_orders(std::vector<std::size_t>{3, 5, 0, 1, 2, 4}, 1);
  for (const auto* order : {&orders.planned, &orders.recorded, &orders.random}) {
    ASSERT_EQ(order->size(), 6u);
    EXPECT_TRUE(std::ranges::is_sorted(*order));
    EXPECT_NEAR(order->back(), 1.0, 1e-12);
    EXPECT_NEAR(order->front(), orders.planned.front(), 1e-12) << "all begin with the same frame";
  }
}

TEST(RecordedSurface, TheRecordedOrderBeginsWithTheFirstTaken) {
  const RecordedSurface surface = surface_of(frames_of_a_plane());
  const CoverageByOrder orders = surface.compare_orders(std::vector<std::size_t>{2}, 1);
  EXPECT_EQ(orders.recorded, surface.coverage(std::vector<std::size_t>{2, 0, 1, 3, 4, 5}));
  EXPECT_EQ(orders.planned.size(), 1u);
}

TEST(RecordedSurface, TheSeedDecidesTheRandomOrders) {
  const RecordedSurface surface = surface_of(frames_of_a_plane());
  const std::vector<std::size_t> taken = {0};
  EXPECT_EQ(surface.compare_orders(taken, 7).random, surface.compare_orders(taken, 7).random);
  EXPECT_NE(surface.compare_orders(taken, 7).random, surface.compare_orders(taken, 8).random);
}

TEST(RecordedSurface, PointsFarOffOrFineCubesAreToldApart) {
  const PointCloud frame = {{1e5f, 0.0f, 0.0f}, {2e5f, 0.0f, 0.0f}, {-1e5f, 0.0f, 0.0f}};  // 2e10 cubes from here
  const auto cloud_of = [&](std::size_t) { return frame; };
  const RecordedSurface surface(1, cloud_of, 1e-5);
  EXPECT_EQ(surface.samples(), frame);
}

TEST(RecordedSurface, WithoutAPointThereIsNoSurface) { EXPECT_THROW(surface_of({{}, {}}), std::invalid_argument); }

}  // namespace
}  // namespace nextview

#include "core/planner/set_cover.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <csignal>
#include <random>

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Views = std::vector<std::vector<Covered>>;

constexpr std::uint32_t elements = 25;

double covered(const Views& views, unsigned chosen) {
  std::vector<double> most(elements, 0.0);
  for (std::size_t v = 0; v < views.size(); ++v)
    if (chosen >> v & 1)
      for (const Covered& c : views[v]) most[c.element] = std::max(most[c.element], double(c.amount));
  double sum = 0.0;
  for (const double amount : most) sum += amount;
  return sum;
}

double covered(const Views& views, const std::vector<std::size_t>& chosen) {
  unsigned set = 0;
  for (const std::size_t v : chosen) set |= 1u << v;
  EXPECT_EQ(std::size_t(std::popcount(set)), chosen.size()) << "no view twice";
  return covered(views, set);
}

/// Of all sets of views.
std::size_t least(const Views& views, double needed) {
  int fewest = 99;
  for (unsigned set = 0; set < 1u << views.size(); ++set)
    if (std::popcount(set) < fewest && covered(views, set) >= needed - 1e-9) fewest = std::popcount(set);
  return std::size_t(fewest);
}

Views random_views(std::mt19937& random, int count, bool graded) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Views views(static_cast<std::size_t>(count));
  for (auto& view : views)
    for (std::uint32_t e = 0; e < elements; ++e)
      if (uniform(random) < 0.25) view.push_back({e, graded ? float(uniform(random)) : 1.0f});
  return views;
}

TEST(SetCover, IsTheLeastOfAllSets) {
  std::mt19937 random(1);
  int smaller_than_greedy = 0;
  for (int round = 0; round < 60; ++round) {
    const Views views = random_views(random, 4 + round % 8, round % 2 == 0);
    const double all = covered(views, (1u << views.size()) - 1), left = all * 0.04 * (round % 3);
    const SetCover cover = least_cover(views, left, CoverLimits::patient());
    EXPECT_TRUE(cover.is_least) << round;
    EXPECT_GE(covered(views, cover.views), all - left - 1e-6) << round;
    EXPECT_EQ(cover.views.size(), least(views, all - left)) << round;
    CoverLimits greedy;
    greedy.views = 0;
    smaller_than_greedy += cover.views.size() < least_cover(views, left, greedy).views.size();
  }
  EXPECT_GT(smaller_than_greedy, 0);
}

TEST(SetCover, WithinTightLimitsItIsACoverAndSaysLeastOnlyWhereItIs) {
  std::mt19937 random(2);
  int proven = 0;
  for (int round = 0; round < 40; ++round) {
    const Views views = random_views(random, 12, round % 2 == 0);
    const double all = covered(views, (1u << views.size()) - 1), left = 0.05 * all;
    const SetCover cover = least_cover(views, left, {64, 8, 5, 2, 1});
    EXPECT_GE(covered(views, cover.views), all - left - 1e-6) << round;
    if (cover.is_least) {
      EXPECT_EQ(cover.views.size(), least(views, all - left)) << round;
    }
    proven += cover.is_least;
  }
  EXPECT_GT(proven, 0);
}

TEST(SetCover, TakesTheViewFirstThatAddsMost) {
  EXPECT_THAT(least_cover(Views{{{0, 1}}, {{1, 5}}, {{2, 3}}}, 0.0).views, ElementsAre(1, 2, 0));
  // The greedy cover takes view 0, then both others; the least does without it.
  const Views views = {{{0, 1}, {1, 1}, {3, 1}, {4, 1}}, {{0, 1}, {1, 1}, {2, 1}}, {{3, 1}, {4, 1}, {5, 1}}};
  EXPECT_THAT(least_cover(views, 0.0).views, ElementsAre(1, 2));
}

TEST(SetCover, OfNothingIsNone) {
  EXPECT_THAT(least_cover({}, 0.0).views, IsEmpty());
  EXPECT_THAT(least_cover(Views(3), 0.0).views, IsEmpty());
  EXPECT_THAT(least_cover(Views{{{0, 1}}, {{1, 2}}}, 3.0).views, IsEmpty());
}

TEST(SetCover, IsTheSameEveryTimeSaysNothingAndLeavesSignalsAlone) {
  std::mt19937 random(3);
  const Views views = random_views(random, 12, true);
  const auto before = std::signal(SIGINT, SIG_DFL);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const SetCover first = least_cover(views, 0.5, CoverLimits::patient());
  for (int again = 0; again < 3; ++again) EXPECT_EQ(least_cover(views, 0.5, CoverLimits::patient()).views, first.views);
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(std::signal(SIGINT, before), SIG_DFL);
}

}  // namespace
}  // namespace nextview

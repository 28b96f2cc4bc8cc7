#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ui/charts/chart.hpp"

namespace nextview {
namespace {

using Ticks = std::vector<double>;

TEST(RoundTicks, StepsAreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_EQ(round_ticks(0, 10, 10, false), (Ticks{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(round_ticks(0, 11, 6, false), (Ticks{0, 2, 4, 6, 8, 10, 12}));
  EXPECT_EQ(round_ticks(3, 22, 5, false), (Ticks{0, 5, 10, 15, 20, 25}));
  EXPECT_EQ(round_ticks(-260, 260, 6, false), (Ticks{-300, -200, -100, 0, 100, 200, 300}));
  EXPECT_EQ(round_ticks(0, 1, 2, false), (Ticks{0, 0.5, 1}));
}

TEST(RoundTicks, WhatIsCountedHasWholeOnes) {
  EXPECT_EQ(round_ticks(0, 2, 8, true), (Ticks{0, 1, 2}));
  EXPECT_EQ(round_ticks(0, 2, 8, false).size(), 5u) << "a half each where halves mean something";
  EXPECT_EQ(round_ticks(0, 40, 8, true), (Ticks{0, 5, 10, 15, 20, 25, 30, 35, 40}));
}

TEST(RoundTicks, ARangeOfNothingIsOneWide) {
  EXPECT_EQ(round_ticks(3, 3, 1, true), (Ticks{3, 4}));
  EXPECT_EQ(round_ticks(3, 2, 1, true), (Ticks{3, 4}));
  EXPECT_EQ(round_ticks(0, 1, 0, false), (Ticks{0, 1})) << "at least one step";
}

TEST(RoundTicks, CoverTheRangeWithNoMoreThanAsked) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-5.0, 5.0), size(-3.0, 6.0);
  for (int n = 0; n < 500; ++n) {
    const double width = std::pow(10.0, size(random)), low = place(random) * width, high = low + width;
    const int count = 1 + n % 12;
    const Ticks ticks = round_ticks(low, high, count, false);
    const double step = ticks[1] - ticks[0];
    EXPECT_LE(ticks.front(), low);
    EXPECT_GT(ticks.front(), low - step) << "none too many below";
    EXPECT_GE(ticks.back(), high - 1e-9 * step);
    EXPECT_LT(ticks.back(), high + step) << "nor above";
    EXPECT_LE(ticks.size(), std::size_t(count) + 2) << "both ends may be a step off";
    EXPECT_GT(step, 0.39 * width / count) << "they are not as few as they could be";
    EXPECT_LT(step, 2.51 * width / count) << "the next round number";
  }
}

}  // namespace
}  // namespace nextview

#include "core/calibration/free_sensor_parameters.hpp"

#include <gtest/gtest.h>

#include "tests/unit/calibration/simulated_histories.hpp"

namespace nextview {
namespace {

using simulated_histories::model;

const InverseSensorModel usual = model(0.82, 0.33, 0.07, 0.93, 0.7, -0.4);

/// What the minimiser may reach far out on both sides.
InverseSensorModel at_end(const FreeSensorParameters& parameters, double free) {
  return parameters.to_model(std::vector<double>(parameters.size(), free));
}

TEST(FreeSensorParameters, AreThoseThatAreAskedFor) {
  EXPECT_EQ(FreeSensorParameters(usual, false, false).size(), 2u);
  EXPECT_EQ(FreeSensorParameters(usual, true, false).size(), 4u);
  EXPECT_EQ(FreeSensorParameters(usual, false, true).size(), 4u);
  EXPECT_EQ(FreeSensorParameters(usual, true, true).size(), 6u);
}

TEST(FreeSensorParameters, ThereAndBackIsTheSameModel) {
  const FreeSensorParameters parameters(usual, true, true);
  for (const InverseSensorModel& m : {usual, model(0.6, 0.45, 0.3, 0.75, -3.0, 4.0)}) {
    const InverseSensorModel back = parameters.to_model(parameters.from_model(m));
    EXPECT_NEAR(back.hit, m.hit, 1e-9);
    EXPECT_NEAR(back.miss, m.miss, 1e-9);
    EXPECT_NEAR(back.clamp_min, m.clamp_min, 1e-9);
    EXPECT_NEAR(back.clamp_max, m.clamp_max, 1e-9);
    EXPECT_NEAR(back.hit_decay, m.hit_decay, 1e-9);
    EXPECT_NEAR(back.miss_decay, m.miss_decay, 1e-9);
  }
}

// Log-odds from 0.01 to those of 1e-4, decays from -5 to 5 per m; 100 is as far out as the numbers tell apart.
TEST(FreeSensorParameters, StayBetweenTheirBounds) {
  const FreeSensorParameters parameters(usual, true, true);
  const InverseSensorModel low = at_end(parameters, -100.0), high = at_end(parameters, 100.0);
  EXPECT_NEAR(log_odds(low.hit), 0.01, 1e-9);
  EXPECT_NEAR(log_odds(low.miss), -0.01, 1e-9);
  EXPECT_NEAR(log_odds(low.clamp_min), -0.01, 1e-9);
  EXPECT_NEAR(log_odds(low.clamp_max), 0.01, 1e-9);
  EXPECT_NEAR(high.hit, 1.0 - 1e-4, 1e-12);
  EXPECT_NEAR(high.miss, 1e-4, 1e-12);
  EXPECT_NEAR(high.clamp_min, 1e-4, 1e-12);
  EXPECT_NEAR(high.clamp_max, 1.0 - 1e-4, 1e-12);
  EXPECT_EQ(low.hit_decay, -5.0);
  EXPECT_EQ(low.miss_decay, -5.0);
  EXPECT_EQ(high.hit_decay, 5.0);
  EXPECT_EQ(high.miss_decay, 5.0);
}

TEST(FreeSensorParameters, ClampsStayOnTheirSidesOfTheThreshold) {
  for (const double threshold : {0.3, 0.6}) {
    InverseSensorModel start = usual;
    start.occupancy_threshold = threshold;
    const InverseSensorModel narrow = at_end(FreeSensorParameters(start, true, false), -100.0);
    // On the other side of 0.5 than the threshold, they keep from 0.5.
    EXPECT_NEAR(log_odds(narrow.clamp_min), -0.01 + std::min(0.0, log_odds(threshold)), 1e-9);
    EXPECT_NEAR(log_odds(narrow.clamp_max), 0.01 + std::max(0.0, log_odds(threshold)), 1e-9);
  }
}

TEST(FreeSensorParameters, WhatIsNotFittedStays) {
  InverseSensorModel start = usual;
  start.occupancy_threshold = 0.6, start.free_below = 0.15, start.occupied_above = 0.85;
  const InverseSensorModel moved = at_end(FreeSensorParameters(start, false, false), 0.3);
  InverseSensorModel expected = start;
  expected.hit = moved.hit, expected.miss = moved.miss;
  EXPECT_EQ(moved, expected);
  EXPECT_NE(moved.hit, start.hit);
  EXPECT_NE(moved.miss, start.miss);
}

TEST(FreeSensorParameters, TheChainIsThatOfFiniteDifferences) {
  const FreeSensorParameters parameters(usual, true, true);
  // Of some function of the model whose gradient by the log-odds and decays is this.
  const std::array<double, sensor_parameters> by_model = {1.5, -2.0, 0.25, 3.0, -0.5, 0.75};
  const auto function = [&](const std::vector<double>& free) {
    const InverseSensorModel m = parameters.to_model(free);
    const std::array<double, sensor_parameters> at = {log_odds(m.hit),       log_odds(m.miss), log_odds(m.clamp_min),
                                                      log_odds(m.clamp_max), m.hit_decay,      m.miss_decay};
    return std::inner_product(at.begin(), at.end(), by_model.begin(), 0.0);
  };
  const std::vector<double> free = {0.3, -0.8, 1.1, -0.2, 0.6, -1.4};
  const std::vector<double> gradient = parameters.chain(free, by_model);
  ASSERT_EQ(gradient.size(), free.size());
  for (std::size_t k = 0; k < free.size(); ++k) {
    std::vector<double> more = free, less = free;
    more[k] += 1e-5, less[k] -= 1e-5;
    EXPECT_NEAR(gradient[k], (function(more) - function(less)) / 2e-5, 1e-6) << k;
  }
}

TEST(FreeSensorParameters, WhatIsAtABoundIsNamed) {
  const FreeSensorParameters parameters(usual, true, true);
  EXPECT_EQ(parameters.at_bounds(usual), "");
  EXPECT_EQ(parameters.at_bounds(at_end(parameters, 100.0)), "hit, miss, clamp_min, clamp_max, hit_decay, miss_decay");
  EXPECT_EQ(parameters.at_bounds(at_end(parameters, -100.0)), "hit, miss, clamp_min, clamp_max, hit_decay, miss_decay");
  InverseSensorModel one = usual;
  one.miss = 1e-4;
  EXPECT_EQ(parameters.at_bounds(one), "miss");
  one.hit_decay = -5.0;
  EXPECT_EQ(parameters.at_bounds(one), "miss, hit_decay");
  EXPECT_EQ(FreeSensorParameters(usual, true, false).at_bounds(one), "miss") << "decays are not fitted";
}

TEST(FreeSensorParameters, TheThresholdMustLeaveRoomForClamps) {
  for (const double threshold : {0.001, 0.999}) {
    InverseSensorModel start = usual;
    start.occupancy_threshold = threshold;
    EXPECT_NO_THROW(FreeSensorParameters(start, false, false)) << threshold;
  }
  for (const double threshold : {0.0009, 0.9991, std::nan("")}) {
    InverseSensorModel start = usual;
    start.occupancy_threshold = threshold;
    EXPECT_THROW(FreeSensorParameters(start, false, false), std::invalid_argument) << threshold;
  }
}

}  // namespace
}  // namespace nextview

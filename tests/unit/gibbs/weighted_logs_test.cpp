#include "core/gibbs/weighted_logs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

TEST(WeightedLogs, AreAsNearToTheLogarithmAsFloatsAre) {
  const CounterRandom draws(1, 0, 0);
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    const auto u = draws.uniform(i);
    const auto far = static_cast<float>(std::exp(-80.0 + 160.0 * u[0]));
    const auto near_one = static_cast<float>(1.0 + (u[0] < 0.5 ? -1.0 : 1.0) * std::exp(-17.0 * u[1]));
    for (const float x : {far, near_one}) {
      if (x < 1e-37f) continue;
      const double expected = std::log(double(x));
      ASSERT_NEAR(WeightedLogs::log(x), expected, 2e-7 * std::max(1.0, std::abs(expected))) << x;
    }
  }
  EXPECT_EQ(WeightedLogs::log(1.0f), 0.0f);
}

TEST(WeightedLogs, AddUpHoweverManyThereAre) {
  for (int count = 0; count < 40; ++count) {
    WeightedLogs logs;
    double expected = 0.0;
    for (int i = 0; i < count; ++i) {
      const float factor = 0.3f + 0.1f * float(i), weight = 0.05f * float(1 + i % 7);
      logs.add(factor, weight);
      expected += double(weight) * std::log(double(factor));
    }
    EXPECT_NEAR(logs.sum(), expected, 1e-5) << count;
  }
}

}  // namespace
}  // namespace nextview

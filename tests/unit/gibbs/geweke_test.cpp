// Geweke's statistic against its textbook definition, and against series whose head and tail are plain to see.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random/counter_random.hpp"
#include "tests/unit/gibbs/plain_diagnostics.hpp"

namespace nextview {
namespace {

using plain::Series;

/// Autoregressive, of variance 1, its mean moved by `drift(t)`, t from 0 to 1.
template <class Drift>
Series series(std::size_t count, double rho, std::uint32_t index, Drift drift) {
  const CounterRandom random(11, 998, index);
  Series values;
  double state = random.normal(count)[0];
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) state = rho * state + std::sqrt(1.0 - rho * rho) * random.normal(i)[0];
    values.push_back(state + drift(double(i) / double(count)));
  }
  return values;
}

constexpr auto flat = [](double) { return 0.0; };
constexpr auto rising = [](double t) { return 2.0 * t; };
constexpr auto falling = [](double t) { return -2.0 * t; };
constexpr auto hump = [](double t) { return std::sin(3.0 * t); };
constexpr auto settling = [](double t) { return -3.0 * std::exp(-12.0 * t); };

template <class Drift>
void expect_geweke(const char* what, double rho, Drift drift) {
  for (std::uint32_t index = 0; index < 20; ++index) {
    const Series x = series(20'000, rho, index, drift);
    const double expected = plain::geweke(x, rho == 0.0 ? 0 : 100);
    // Standard errors are estimated in different ways: within a fifth of each other, as n grows.
    EXPECT_NEAR(geweke_z(x), expected, 0.15 + 0.2 * std::abs(expected)) << what << ", rho " << rho;
  }
}

TEST(Geweke, IsThatOfTheTextbook) {
  for (const double rho : {0.0, 0.5, 0.8}) {
    expect_geweke("flat", rho, flat);
    expect_geweke("hump", rho, [](double t) { return 0.2 * hump(t); });
    expect_geweke("settling", rho, [](double t) { return 0.3 * settling(t); });
  }
}

/// Noise whose only feature lies between two places [shares of its length].
double z_of_step(double from, double to) {
  return geweke_z(series(10'000, 0.0, 3, [&](double t) { return t >= from && t < to ? 1.0 : 0.0; }));
}

// What lies in the first tenth counts, and in the last half; what lies between does not.
TEST(Geweke, LooksAtTheFirstTenthAndTheLastHalf) {
  EXPECT_GT(z_of_step(0.0, 0.1), 20.0);
  EXPECT_LT(std::abs(z_of_step(0.1, 0.5)), 2.0);
  EXPECT_LT(z_of_step(0.5, 0.9), -10.0) << "the tail is a half, not a tenth";
  EXPECT_LT(z_of_step(0.5, 1.0), -20.0);
  EXPECT_LT(z_of_step(0.9, 1.0), -2.0);
  const double quarter = z_of_step(0.0, 0.025), half = z_of_step(0.0, 0.05);
  EXPECT_GT(quarter, 4.0);
  EXPECT_GT(half, 1.5 * quarter) << "a part of the head counts by its share";
}

TEST(Geweke, IsPositiveWhereTheSeriesFalls) {
  for (std::uint32_t index = 0; index < 5; ++index) {
    EXPECT_GT(geweke_z(series(2'000, 0.3, index, falling)), 4.0);
    EXPECT_LT(geweke_z(series(2'000, 0.3, index, rising)), -4.0);
  }
}

}  // namespace
}  // namespace nextview

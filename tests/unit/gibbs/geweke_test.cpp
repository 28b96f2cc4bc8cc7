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

/// A level for the first tenth, one for what follows, and one for the last half.
struct SteppedDrift {
  double head, between, tail;
  double operator()(double t) const { return t < 0.1 ? head : t < 0.5 ? between : tail; }
};

TEST(Geweke, IsThatOfTheTextbook) {
  for (const double rho : {0.0, 0.5, 0.8})
    for (const SteppedDrift levels : {SteppedDrift{0, 0, 0}, {0.1, 0, 0}, {0, 3, 0}, {-0.3, -2, 0.1}, {0.2, 0, 0.5}})
      for (std::uint32_t index = 0; index < 5; ++index) {
        const Series x = series(100'000, rho, index, levels);
        const double expected = plain::geweke(x, rho == 0.0 ? 0 : 100);
        // Both estimate the standard errors, in different ways.
        EXPECT_NEAR(geweke_z(x), expected, 0.15 + 0.15 * std::abs(expected)) << "rho " << rho;
      }
}

/// What a small step between two places [shares of the length] adds to the z of noise.
double added_by_step(double from, double to) {
  const auto z = [&](double size) {
    return geweke_z(series(40'000, 0.0, 3, [&](double t) { return t >= from && t < to ? size : 0.0; }));
  };
  return z(0.1) - z(0.0);
}

// What lies in the first tenth counts, and in the last half; what lies between does not.
TEST(Geweke, LooksAtTheFirstTenthAndTheLastHalf) {
  const double standard_error = std::sqrt(1.0 / 4'000 + 1.0 / 20'000), all = 0.1 / standard_error;
  EXPECT_NEAR(added_by_step(0.0, 0.1), all, 0.1 * all);
  EXPECT_NEAR(added_by_step(0.0, 0.05), 0.5 * all, 0.1 * all);
  EXPECT_NEAR(added_by_step(0.1, 0.5), 0.0, 1e-9);
  EXPECT_NEAR(added_by_step(0.5, 0.9), -0.8 * all, 0.1 * all) << "the tail is a half, not a tenth";
  EXPECT_NEAR(added_by_step(0.9, 1.0), -0.2 * all, 0.1 * all);
}

TEST(Geweke, IsPositiveWhereTheSeriesFalls) {
  for (std::uint32_t index = 0; index < 5; ++index) {
    EXPECT_GT(geweke_z(series(2'000, 0.3, index, [](double t) { return -2.0 * t; })), 3.0);
    EXPECT_LT(geweke_z(series(2'000, 0.3, index, [](double t) { return 2.0 * t; })), -3.0);
  }
}

}  // namespace
}  // namespace nextview

#include "core/evaluation/repeated_sum.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace nextview {
namespace {

double one_by_one(double sum, double term, std::size_t times) {
  for (; times > 0; --times) sum += term;
  return sum;
}

TEST(RepeatedSum, IsThatOfTermsOneByOneToTheLastBit) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-60.0, 8.0), mantissa(1.0, 2.0);
  for (int n = 0; n < 20'000; ++n) {
    double sum = n % 5 == 0 ? 0.0 : std::exp2(exponent(random)) * mantissa(random);
    double term = n % 7 == 0 ? float(mantissa(random)) * 0x1p-3 : std::exp2(exponent(random)) * mantissa(random);
    if (n % 3 == 0) term = sum * std::exp2(-double(random() % 55)) * (n % 2 == 0 ? 1.0 : 0.5);  // halves of last places
    const std::size_t times = random() % 600;
    const double expected = one_by_one(sum, term, times), before = sum;
    add_times(sum, term, times);
    ASSERT_EQ(sum, expected) << before << " + " << times << " times " << term;
  }
}

TEST(RepeatedSum, TakesAnyTerms) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double term : {0.0, -0.25, -1e-17, 1e300, infinite})
    for (double sum : {0.0, -3.0, 1.5, 1e308}) {
      const double expected = one_by_one(sum, term, 50);
      add_times(sum, term, 50);
      EXPECT_EQ(sum, expected) << term;
    }
  double sum = 1.0;
  add_times(sum, std::numeric_limits<double>::quiet_NaN(), 9);
  EXPECT_TRUE(std::isnan(sum));
}

}  // namespace
}  // namespace nextview

#include "core/gibbs/sampler_diagnostics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <vector>

#include "core/random/counter_random.hpp"
#include "tests/unit/gibbs/plain_diagnostics.hpp"

namespace nextview {
namespace {

using plain::Series;

double r_hat(std::initializer_list<Series> chains) {
  const std::vector<std::span<const double>> views(chains.begin(), chains.end());
  return split_r_hat(views);
}
double effective(std::initializer_list<Series> chains) {
  const std::vector<std::span<const double>> views(chains.begin(), chains.end());
  return effective_sample_size(views);
}

/// Independent standard normal numbers, different for each `index`.
Series normals(std::size_t count, std::uint32_t index) {
  const CounterRandom random(7, 999, index);
  Series values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(random.normal(i)[0]);
  return values;
}

/// x_t = rho x_{t-1} + e_t, from its stationary distribution: autocorrelation rho^k.
Series autoregressive(std::size_t count, double rho, std::uint32_t index) {
  Series values = normals(count, index);
  values[0] /= std::sqrt(1.0 - rho * rho);
  for (std::size_t i = 1; i < count; ++i) values[i] += rho * values[i - 1];
  return values;
}

Series plus(Series values, double offset) {
  for (double& value : values) value += offset;
  return values;
}
Series line(std::size_t count, double from, double to) {
  Series values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1));
  return values;
}

TEST(SplitRHat, isOneForIndependentDrawsOfOneDistribution) {
  EXPECT_NEAR(r_hat({normals(20'000, 1)}), 1.0, 0.001);
  EXPECT_NEAR(r_hat({normals(20'000, 1), normals(20'000, 2), normals(20'000, 3)}), 1.0, 0.001);
}

TEST(SplitRHat, ofChainsAtDifferentMeans) {
  // Four halves at +1, +1, -1, -1, of variance 1: R^2 = 1 + 4/3.
  EXPECT_NEAR(r_hat({plus(normals(20'000, 1), 1.0), plus(normals(20'000, 2), -1.0)}), std::sqrt(1.0 + 4.0 / 3.0), 0.02);
}

TEST(SplitRHat, seesChainsThatDriftTogether) {
  // Halves of a line from 0 to 1: means 1/4, 3/4, variance 1/48.
  EXPECT_NEAR(r_hat({line(20'000, 0.0, 1.0)}), std::sqrt(1.0 + 0.125 * 48.0), 0.001);
  EXPECT_NEAR(r_hat({line(20'000, 0.0, 1.0), line(20'000, 0.0, 1.0)}), std::sqrt(1.0 + 48.0 / 12.0), 0.001);
}

TEST(SplitRHat, ofConstants) {
  EXPECT_EQ(r_hat({Series(10, 3.0)}), 1.0);
  EXPECT_EQ(r_hat({Series(10, 3.0), Series(10, 3.0)}), 1.0);
  EXPECT_EQ(r_hat({Series(10, 3.0), Series(10, 4.0)}), HUGE_VAL) << "they stand still at different places";
  EXPECT_EQ(r_hat({Series(4, 0.1), Series(4, 0.1), Series(4, 0.1)}), 1.0) << "0.1 is not exact";
}

TEST(SplitRHat, doesNotDependOnOffsetOrScale) {
  const Series a = autoregressive(500, 0.8, 1), b = plus(autoregressive(500, 0.8, 2), 0.5);
  const double expected = r_hat({a, b});
  Series far = a, far_b = b;
  for (double& value : far) value = -1e5 + 1e3 * value;
  for (double& value : far_b) value = -1e5 + 1e3 * value;
  EXPECT_NEAR(r_hat({far, far_b}), expected, 1e-6);
  EXPECT_EQ(r_hat({b, a}), expected);
}

TEST(EffectiveSampleSize, ofIndependentDrawsIsTheirNumber) {
  EXPECT_NEAR(effective({normals(20'000, 1)}) / 20'000, 1.0, 0.1);
  EXPECT_NEAR(effective({normals(5'000, 1), normals(5'000, 2), normals(5'000, 3), normals(5'000, 4)}) / 20'000, 1.0,
              0.1);
}

TEST(EffectiveSampleSize, ofAutoregressiveChains) {
  for (const double rho : {0.3, 0.6, 0.9, 0.97}) {
    const double expected = (1.0 - rho) / (1.0 + rho);
    EXPECT_NEAR(effective({autoregressive(100'000, rho, 1)}) / 1e5, expected, 0.15 * expected) << rho;
    EXPECT_NEAR(effective({autoregressive(50'000, rho, 2), autoregressive(50'000, rho, 3)}) / 1e5, expected,
                0.15 * expected)
        << rho;
  }
}

TEST(EffectiveSampleSize, ofDrawsThatAlternateIsNotLessThanTheirNumber) {
  EXPECT_GT(effective({autoregressive(20'000, -0.5, 1)}), 18'000);
}

TEST(EffectiveSampleSize, ofChainsThatDisagreeIsNextToNothing) {
  EXPECT_LT(effective({normals(5'000, 1), plus(normals(5'000, 2), 10.0)}), 20.0);
  EXPECT_LT(effective({line(5'000, 0.0, 1.0)}), 20.0);
}

TEST(EffectiveSampleSize, ofConstantsIsTheirNumber) {
  EXPECT_EQ(effective({Series(10, 3.0)}), 10.0);
  EXPECT_EQ(effective({Series(10, 0.1), Series(10, 0.1)}), 20.0);
}

TEST(EffectiveSampleSize, staysWithinBoundsForShortChains) {
  for (std::uint32_t index = 0; index < 500; ++index) {
    const double size = effective({normals(4, 2 * index), normals(4, 2 * index + 1)});
    ASSERT_TRUE(std::isfinite(size));
    ASSERT_GT(size, 0.0);
  }
}

TEST(GewekeZ, rarelyRaisesAFalseAlarm) {
  constexpr int chains = 2'000;
  for (const double rho : {0.0, 0.6}) {
    int alarms = 0, strong_alarms = 0;
    double sum = 0.0;
    for (std::uint32_t index = 0; index < chains; ++index) {
      const double z = geweke_z(autoregressive(2'000, rho, index));
      sum += z;
      alarms += std::abs(z) > 1.96;
      strong_alarms += std::abs(z) > 2.576;
    }
    EXPECT_NEAR(sum / chains, 0.0, 0.1) << rho;
    EXPECT_GT(alarms, 0.03 * chains) << rho << ": nominal: 5 %";
    EXPECT_LT(alarms, 0.09 * chains) << rho << ": nominal: 5 %";
    EXPECT_LT(strong_alarms, 0.03 * chains) << rho << ": nominal: 1 %";
  }
}

TEST(GewekeZ, isAsRareAsItSaysForFewValuesToo) {
  constexpr int chains = 20'000;
  for (const std::size_t size : {12u, 16u, 20u, 32u}) {
    int alarms = 0, strong_alarms = 0;
    for (std::uint32_t index = 0; index < chains; ++index) {
      const double z = geweke_z(normals(size, index));
      alarms += std::abs(z) > 1.96;
      strong_alarms += std::abs(z) > 2.576;
    }
    EXPECT_GT(alarms, 0.02 * chains) << size << ": nominal: 5 %";
    EXPECT_LT(alarms, 0.06 * chains) << size << ": nominal: 5 %";
    EXPECT_GT(strong_alarms, 0.002 * chains) << size << ": nominal: 1 %";
    EXPECT_LT(strong_alarms, 0.012 * chains) << size << ": nominal: 1 %";
  }
}

TEST(GewekeZ, seesATrend) {
  EXPECT_GT(std::abs(geweke_z(line(1'000, 0.0, 1.0))), 3.0) << "a line looks like slow mixing, too";
  Series rising = normals(1'000, 1);
  for (std::size_t i = 0; i < rising.size(); ++i) rising[i] += 3.0 * static_cast<double>(i) / 1e3;
  EXPECT_GT(std::abs(geweke_z(rising)), 4.0);
  EXPECT_LT(std::abs(geweke_z(normals(1'000, 1))), 3.0) << "the noise alone";
  Series start = normals(1'000, 2);  // a burn-in that was not left out
  for (std::size_t i = 0; i < 100; ++i) start[i] -= 2.0;
  EXPECT_GT(std::abs(geweke_z(start)), 4.0);
}

TEST(GewekeZ, doesNotTakeSlowMixingForATrend) {
  // Standard errors that take draws for independent would be four times too small here.
  int alarms = 0;
  for (std::uint32_t index = 0; index < 1'000; ++index)
    alarms += std::abs(geweke_z(autoregressive(3'000, 0.9, index))) > 1.96;
  EXPECT_LT(alarms, 150);
}

TEST(GewekeZ, ofAConstantIsZero) {
  EXPECT_EQ(geweke_z(Series(100, 5.0)), 0.0);
  EXPECT_EQ(geweke_z(Series(100, 0.1)), 0.0);
}

}  // namespace
}  // namespace nextview

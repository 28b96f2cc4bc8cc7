#include <gtest/gtest.h>

#include <cmath>

#include "core/evaluation/baseline_maps.hpp"

namespace nextview {
namespace {

/// The posterior by summing the likelihood over the share of rays that a voxel stops, free or occupied (midpoints).
double integrated_posterior(int hits, int misses) {
  constexpr int steps = 2'000'000;
  double occupied = 0.0, free = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double q = (i + 0.5) / steps, log_q = std::log(q), log_rest = std::log1p(-q);
    const double likelihood = std::exp(hits * log_q + misses * log_rest);
    occupied += likelihood * 2.0 * (1.0 - q);                 // Beta(1, 2)
    free += likelihood * 999.0 * std::exp(998.0 * log_rest);  // Beta(1, 999)
  }
  return 0.05 * occupied / (0.05 * occupied + 0.95 * free);
}

TEST(BetaBinomial, IsTheIntegralOverTheShare) {
  EXPECT_NEAR(beta_binomial({}), 0.05, 1e-12);  // no ray: its prior; the map says 0.5 and not measured
  for (const auto& [hits, misses] : std::vector<std::pair<int, int>>{{0, 1},
                                                                     {1, 0},
                                                                     {1, 1},
                                                                     {0, 10},
                                                                     {1, 30},
                                                                     {1, 300},
                                                                     {1, 1000},
                                                                     {2, 2000},
                                                                     {3, 2},
                                                                     {12, 200},
                                                                     {3, 1000},
                                                                     {0, 3000},
                                                                     {0, 6000}}) {
    const RayCounts counts{std::uint32_t(hits), std::uint32_t(misses), 0, 0};
    EXPECT_NEAR(beta_binomial(counts), integrated_posterior(hits, misses), 1e-7) << hits << ' ' << misses;
  }
  // 1 hit: 0.05 / 3 against 0.95 / 1000. By hand, E[q] is 1/3 and 1/1000.
  EXPECT_NEAR(beta_binomial({1, 0, 0, 0}), 0.05 / 3 / (0.05 / 3 + 0.95 / 1000), 1e-12);
}

TEST(BetaBinomial, ManyRaysNeitherOverflowNorLeaveTheUnitInterval) {
  EXPECT_NEAR(beta_binomial({100'000, 100'000, 0, 0}), 1.0, 1e-12);
  for (const std::uint32_t many : {10'000u, 1'000'000u, 4'000'000'000u})
    for (const RayCounts& counts : {RayCounts{many, 0, 0, 0}, RayCounts{0, many, 0, 0}, RayCounts{many, many, 0, 0}}) {
      EXPECT_GE(beta_binomial(counts), 0.0) << many;
      EXPECT_LE(beta_binomial(counts), 1.0) << many;
    }
}

// By hand: without a hit the likelihoods are 2 / (2 + misses) and 999 / (999 + misses). With a false-hit rate of
// exactly 0.001, from about 11,700 misses on a lower share of hits would fit better, and be called occupied.
TEST(BetaBinomial, PassesWithoutAHitSayFreeHoweverManyThereAre) {
  double before = 0.05;
  for (const std::uint32_t misses : {1u, 10u, 100u, 1'000u, 11'000u, 12'000u, 100'000u, 1'000'000u}) {
    const double p = beta_binomial({0, misses, 0, 0}), n = misses;
    const double odds = 0.05 / 0.95 * (2.0 / (2.0 + n)) * (999.0 + n) / 999.0;
    EXPECT_NEAR(p / (odds / (1.0 + odds)), 1.0, 1e-7) << misses;
    EXPECT_LT(p, before) << misses;
    before = p;
  }
  EXPECT_NEAR(beta_binomial({0, 4'000'000'000, 0, 0}), 1.0535e-4, 1e-7);  // the limit, 2 / 999 of the prior's odds
}

TEST(BetaBinomial, WithManyRaysAShareOfHitsDecides) {
  for (const std::uint32_t thousands : {1'000u, 1'000'000u}) {
    EXPECT_LT(beta_binomial({8 * thousands, 992 * thousands, 0, 0}), 0.5) << thousands;
    EXPECT_GT(beta_binomial({10 * thousands, 990 * thousands, 0, 0}), 0.5) << thousands;
  }
}

}  // namespace
}  // namespace nextview

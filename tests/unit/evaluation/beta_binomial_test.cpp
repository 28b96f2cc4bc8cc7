#include <gtest/gtest.h>

#include <cmath>

#include "core/evaluation/baseline_maps.hpp"

namespace nextview {
namespace {

/// The posterior by summing the likelihood over the share of rays that an occupied voxel stops (midpoints).
double integrated_posterior(int hits, int passes) {
  constexpr int steps = 2'000'000;
  double occupied = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double q = (i + 0.5) / steps, density = 2.0 * (1.0 - q);  // Beta(1, 2)
    occupied += std::exp(hits * std::log(q) + passes * std::log1p(-q)) * density / steps;
  }
  const double free = std::pow(0.001, hits) * std::pow(0.999, passes);
  return 0.05 * occupied / (0.05 * occupied + 0.95 * free);
}

TEST(BetaBinomial, IsTheIntegralOverTheShare) {
  EXPECT_NEAR(beta_binomial({}), 0.05, 1e-12);  // no ray: its prior; the map says 0.5 and not measured
  for (const auto& [hits, passes] : std::vector<std::pair<int, int>>{{0, 1},
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
    const RayCounts counts{std::uint32_t(hits), std::uint32_t(passes), 0, 0};
    EXPECT_NEAR(beta_binomial(counts), integrated_posterior(hits, passes), 1e-7) << hits << ' ' << passes;
  }
  // 1 hit: 0.05 / 3 against 0.95 / 1000. By hand, E[q] = 1/3.
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

TEST(BetaBinomial, PassesWithoutAHitSayFreeUpToItsKnownLimit) {
  EXPECT_LT(beta_binomial({0, 1'000, 0, 0}), 1e-3);
  EXPECT_LT(beta_binomial({0, 11'000, 0, 0}), 0.5);
  EXPECT_GT(beta_binomial({0, 12'000, 0, 0}), 0.5);
}

}  // namespace
}  // namespace nextview

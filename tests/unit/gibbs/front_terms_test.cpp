#include "core/gibbs/front_terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/gibbs/optical_depth.hpp"
#include "core/gibbs/weighted_logs.hpp"
#include "core/random/counter_random.hpp"
#include "tests/unit/map/instruction_sets.hpp"

namespace nextview {
namespace {

/// Rays and entries at random; some rays are blocked, some say nothing.
struct RaysAndEntries {
  std::vector<RayLists::FrontEntry> entries;
  std::vector<RayWitness> rays;
  std::vector<RaySurvival> survivals;
  std::vector<OfChords<PassingPair>> passing = std::vector<OfChords<PassingPair>>(3);
  OfChords<std::int32_t> own_depth;

  RaysAndEntries(std::size_t count, std::uint64_t seed) {
    const CounterRandom draws(seed, 0, 0);
    constexpr std::size_t ray_count = 1000;
    for (std::size_t r = 0; r < ray_count; ++r) {
      const auto u = draws.uniform(r);
      const auto depth =
          static_cast<std::int32_t>(optical_depth::opaque * (u[1] < 0.3 ? 2.0 * u[0] : 0.1 * u[0] * u[0]));
      survivals.push_back({static_cast<float>(u[2] < 0.1 ? 0.0 : std::exp(10.0 * u[2] - 3.0)), depth + 2048});
      rays.push_back({survivals.back().near_sum * optical_depth::passing(depth + 2048), static_cast<float>(u[3])});
    }
    for (std::uint32_t code = 0; code < RayLists::chord_codes; ++code) {
      for (int level = 0; level < 5; ++level)
        passing[level / 2][code][level % 2] =
            level == 2 ? 0.0f : static_cast<float>(std::exp(-0.1 * (level + 1) * code / 1023.0));
      own_depth[code] = static_cast<std::int32_t>(2 * code);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto u = draws.uniform(ray_count + k);
      entries.push_back({static_cast<std::uint32_t>(u[0] * ray_count) << 10 | static_cast<std::uint32_t>(u[1] * 1024)});
    }
    entries.resize(count + RayLists::entries_beyond, {0xffffffff});  // of no ray
  }
  FrontTerms terms(bool is_free) const {
    return {std::span(entries).first(entries.size() - RayLists::entries_beyond), rays.data(), survivals.data(), passing,
            is_free ? nullptr : &own_depth};
  }
};

/// The same, ray by ray; of one level, the first is asked alone.
bool add_plainly(const FrontTerms& terms, double enough, std::span<double> log_weights) {
  const auto term_of = [&](std::size_t k, std::size_t q) {
    const RayLists::FrontEntry entry = terms.entries[k];
    const RaySurvival& survival = terms.survivals[entry.ray()];
    float s = terms.rays[entry.ray()].s;
    if (terms.own_depth)
      s = survival.near_sum * optical_depth::passing(survival.depth - (*terms.own_depth)[entry.chord()]);
    const float factor = (1.0f + s * terms.passing[q / 2][entry.chord()][q % 2]) / (1.0f + s);
    return terms.rays[entry.ray()].evidence * WeightedLogs::log(factor);
  };
  const std::size_t count = terms.entries.size();
  if (log_weights.size() == 1 && !terms.own_depth && count > 0 && log_weights[0] + term_of(0, 0) < enough) {
    log_weights[0] += term_of(0, 0);
    return true;
  }
  for (std::size_t begin = 0; begin < count; begin += FrontTerms::block) {
    for (std::size_t q = 0; q < log_weights.size(); ++q) {
      std::array<float, FrontTerms::block> logs{};
      for (std::size_t i = 0; i < std::min(FrontTerms::block, count - begin); ++i) logs[i] = term_of(begin + i, q);
      for (std::size_t half = FrontTerms::block / 2; half > 0; half /= 2)
        for (std::size_t i = 0; i < half; ++i) logs[i] += logs[i + half];
      log_weights[q] += logs[0];
    }
    if (*std::ranges::max_element(log_weights) < enough) return true;
  }
  return false;
}

TEST(OpticalDepth, SaysWhatPasses) {
  for (std::int32_t depth = 0; depth < optical_depth::opaque; depth += 1 + depth / 50) {
    const double expected = std::exp(-double(depth) / optical_depth::unit);
    if (expected < 1e-30) break;
    ASSERT_NEAR(optical_depth::passing(depth), expected, 1e-6 * expected) << depth;
  }
  EXPECT_EQ(optical_depth::passing(optical_depth::opaque), 0.0f);
  EXPECT_EQ(optical_depth::passing(std::numeric_limits<std::int32_t>::max()), 0.0f);
}

class FrontTermsOn : public OnInstructionSet {};

TEST_P(FrontTermsOn, AreThePlainSumToTheLastBit) {
  for (std::size_t count = 0; count < 600; count += count < 70 ? 1 : 59) {
    const RaysAndEntries problem(count, count);
    for (const bool is_free : {false, true})
      for (const std::size_t levels : {1, 2, 3, 4, 5})
        for (const double enough : {-std::numeric_limits<double>::infinity(), -1.5, 0.0}) {
          std::vector<double> weights(levels, -0.5), expected = weights;
          const bool settled = add_front_terms(problem.terms(is_free), enough, weights);
          ASSERT_EQ(settled, add_plainly(problem.terms(is_free), enough, expected)) << count;
          ASSERT_EQ(weights, expected) << count << " rays, " << levels << " levels, free: " << is_free;
        }
  }
}

TEST_P(FrontTermsOn, StopOnlyWhereNothingCouldReachEnough) {
  const RaysAndEntries problem(500, 7);
  std::vector<double> all(2), some(2);
  EXPECT_FALSE(add_front_terms(problem.terms(true), -std::numeric_limits<double>::infinity(), all));
  EXPECT_LT(all[1], all[0]);
  EXPECT_LT(all[0], -1.0);
  EXPECT_TRUE(add_front_terms(problem.terms(true), 0.5 * all[0], some));
  EXPECT_LT(some[0], 0.5 * all[0]);
  EXPECT_GE(some[0], all[0]);
}

INSTANTIATE_TEST_SUITE_P(All, FrontTermsOn, instruction_sets(), instruction_set_name);

}  // namespace
}  // namespace nextview

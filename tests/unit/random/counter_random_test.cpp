#include "core/random/counter_random.hpp"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <new>
#include <random>
#include <vector>

namespace nextview {
namespace {

constexpr double step = 1.0 / 4294967296.0;  // one of the 2^32 steps of a word

bool is_words(const std::array<double, 4>& uniform, const std::array<std::uint32_t, 4>& words) {
  for (int i = 0; i < 4; ++i)
    if (std::abs(uniform[i] - (words[i] + 0.5) * step) > 0.1 * step) return false;
  return true;
}

// Random123's published known answers (kat_vectors, philox4x32 10). All bits alike, so the layout of the key does not
// matter.
TEST(CounterRandom, GivesThePublishedKnownAnswers) {
  const std::uint32_t ones = 0xffffffffu;
  EXPECT_TRUE(is_words(CounterRandom(0, 0, 0).uniform(0), {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_TRUE(is_words(CounterRandom(~std::uint64_t(0), ones, ones).uniform(~std::uint64_t(0)),
                       {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
}

// The seed is the key; counter, stream and index fill the 128 bits of the counter in some fixed order.
TEST(CounterRandom, IsPhiloxOfRandom123InOneLayoutOfItsWords) {
  std::array<int, 4> order = {0, 1, 2, 3};
  int layouts = 0;
  do {
    for (const bool swap_seed : {false, true}) {
      std::mt19937_64 inputs(7);
      bool agrees = true;
      for (int n = 0; n < 200 && agrees; ++n) {
        const std::uint64_t seed = inputs(), counter = inputs();
        const auto stream = std::uint32_t(inputs()), index = std::uint32_t(inputs());
        const std::array<std::uint32_t, 4> parts = {std::uint32_t(counter), std::uint32_t(counter >> 32), stream,
                                                    index};
        r123::Philox4x32::ctr_type c;
        for (int i = 0; i < 4; ++i) c[i] = parts[order[i]];
        const std::uint32_t low = std::uint32_t(seed), high = std::uint32_t(seed >> 32);
        const r123::Philox4x32::key_type k{{swap_seed ? high : low, swap_seed ? low : high}};
        const auto words = r123::Philox4x32()(c, k);
        agrees =
            is_words(CounterRandom(seed, stream, index).uniform(counter), {words[0], words[1], words[2], words[3]});
      }
      layouts += agrees;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(layouts, 1);
}

/// The chi-square statistic as a standard normal number (Wilson and Hilferty 1931).
double chi_square_deviation(const std::vector<int>& counts, double expected) {
  double chi = 0.0;
  for (const int n : counts) chi += (n - expected) * (n - expected) / expected;
  const double degrees = double(counts.size()) - 1.0, spread = 2.0 / (9.0 * degrees);
  return (std::cbrt(chi / degrees) - (1.0 - spread)) / std::sqrt(spread);
}

TEST(CounterRandom, IsUniformAlongCountersStreamsIndicesAndSeeds) {
  constexpr int draws = 1 << 18, cells = 256;
  const auto draw = [](int along, std::uint64_t n) {
    return along == 0   ? CounterRandom(5, 1, 2).uniform(n)
           : along == 1 ? CounterRandom(5, std::uint32_t(n), 2).uniform(3)
           : along == 2 ? CounterRandom(5, 1, std::uint32_t(n)).uniform(3)
                        : CounterRandom(n, 1, 2).uniform(3);
  };
  for (int along = 0; along < 4; ++along) {
    std::vector<std::vector<int>> counts(4, std::vector<int>(cells));
    for (int n = 0; n < draws; ++n) {
      const auto u = draw(along, n);
      for (int i = 0; i < 4; ++i) {
        ASSERT_GT(u[i], 0.0);
        ASSERT_LT(u[i], 1.0);
        ++counts[i][int(u[i] * cells)];
      }
    }
    for (int i = 0; i < 4; ++i)
      EXPECT_LT(std::abs(chi_square_deviation(counts[i], double(draws) / cells)), 4.5) << along << " word " << i;
  }
}

// Pairs of draws that must not depend on each other fill the cells of a square evenly.
TEST(CounterRandom, NeighboursAreIndependent) {
  constexpr int draws = 1 << 17, side = 16;
  using Pair = std::function<std::array<double, 2>(std::uint64_t)>;
  const std::map<std::string, Pair> pairs = {
      {"words",
       [](auto n) {
         const auto u = CounterRandom(1, 1).uniform(n);
         return std::array{u[0], u[1]};
       }},
      {"other words",
       [](auto n) {
         const auto u = CounterRandom(1, 1).uniform(n);
         return std::array{u[2], u[3]};
       }},
      {"counters",
       [](auto n) {
         const CounterRandom r(1, 1);
         return std::array{r.uniform(n)[0], r.uniform(n + 1)[0]};
       }},
      {"streams",
       [](auto n) {
         return std::array{CounterRandom(1, 1).uniform(n)[0], CounterRandom(1, 2).uniform(n)[0]};
       }},
      {"indices",
       [](auto n) {
         return std::array{CounterRandom(1, 1, 0).uniform(n)[0], CounterRandom(1, 1, 1).uniform(n)[0]};
       }},
      {"seeds",
       [](auto n) {
         return std::array{CounterRandom(1, 1).uniform(n)[0], CounterRandom(2, 1).uniform(n)[0]};
       }},
      {"high halves of seeds", [](auto n) {
         return std::array{CounterRandom(1, 1).uniform(n)[0], CounterRandom(1 + (1ull << 32), 1).uniform(n)[0]};
       }}};
  for (const auto& [name, pair] : pairs) {
    std::vector<int> counts(side * side);
    for (int n = 0; n < draws; ++n) {
      const auto [a, b] = pair(n);
      ++counts[int(a * side) * side + int(b * side)];
    }
    EXPECT_LT(std::abs(chi_square_deviation(counts, double(draws) / (side * side))), 4.5) << name;
  }
}

// They are made where they are wanted: what is kept right behind them stays.
TEST(CounterRandom, AreFourNumbersAndNoFifth) {
  using Numbers = std::array<double, 4>;
  alignas(Numbers) std::array<std::byte, sizeof(Numbers) + 2 * sizeof(double)> memory;
  memory.fill(std::byte{0x5a});
  const auto& four = *new (memory.data()) Numbers(CounterRandom(1, 1).uniform(3));
  EXPECT_EQ(four, CounterRandom(1, 1).uniform(3));
  for (std::size_t i = sizeof(Numbers); i < memory.size(); ++i) EXPECT_EQ(memory[i], std::byte{0x5a}) << i;
}

TEST(CounterRandom, DependsOnKeyAndCounterAlone) {
  const CounterRandom a(9, 2, 4);
  const auto first = a.uniform(77);
  for (int n = 0; n < 100; ++n) a.uniform(n);
  EXPECT_EQ(a.uniform(77), first);
  EXPECT_EQ(CounterRandom(9, 2, 4).uniform(77), first);
  EXPECT_EQ(CounterRandom(9, 2, 4).normal(77), a.normal(77));
}

// Kolmogorov and Smirnov's distance to the normal distribution, and no correlation between the two numbers of a draw.
TEST(CounterRandom, NormalNumbersAreNormal) {
  constexpr int draws = 100'000;
  std::array<std::vector<double>, 2> values;
  double product = 0.0, squares = 0.0;
  for (int n = 0; n < draws; ++n) {
    const auto z = CounterRandom(3, 1).normal(n);
    for (int i = 0; i < 2; ++i) values[i].push_back(z[i]);
    product += z[0] * z[1];
    squares += (z[0] * z[0] - 1.0) * (z[1] * z[1] - 1.0);
  }
  for (auto& v : values) {
    std::sort(v.begin(), v.end());
    double distance = 0.0;
    for (int n = 0; n < draws; ++n) {
      const double expected = 0.5 * std::erfc(-v[n] / std::sqrt(2.0));
      distance = std::max({distance, std::abs(expected - double(n) / draws), std::abs(expected - (n + 1.0) / draws)});
    }
    EXPECT_LT(distance, 2.2 / std::sqrt(draws));
    EXPECT_GT(v.back(), 3.7);
    EXPECT_LT(v.front(), -3.7);
  }
  EXPECT_LT(std::abs(product) / std::sqrt(draws), 4.5);
  EXPECT_LT(std::abs(squares) / std::sqrt(4.0 * draws), 4.5);
}

TEST(CounterRandom, NormalNumbersAreFiniteWhereUniformOnesAreExtreme) {
  for (std::uint64_t n = 0; n < 2'000'000; ++n) {
    const auto z = CounterRandom(11, 3).normal(n);
    ASSERT_TRUE(std::isfinite(z[0]) && std::isfinite(z[1])) << n;
  }
}

}  // namespace
}  // namespace nextview

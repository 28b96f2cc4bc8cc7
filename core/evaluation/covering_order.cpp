#include "core/evaluation/covering_order.hpp"

#include <algorithm>
#include <numeric>

#include "core/random/counter_random.hpp"

namespace nextview {

std::vector<std::size_t> covering_order(std::span<const std::vector<std::uint32_t>> seen_from, std::size_t samples,
                                        std::uint64_t seed) {
  std::vector<std::size_t> cover, others(seen_from.size());
  std::iota(others.begin(), others.end(), std::size_t{0});
  std::vector<std::uint8_t> covered(samples);
  const auto adds = [&](std::size_t view) {
    return std::count_if(seen_from[view].begin(), seen_from[view].end(), [&](std::uint32_t s) { return !covered[s]; });
  };
  while (!others.empty()) {
    const auto best = std::max_element(others.begin(), others.end(), [&](auto a, auto b) { return adds(a) < adds(b); });
    if (adds(*best) == 0) break;
    for (const std::uint32_t s : seen_from[*best]) covered[s] = 1;
    cover.push_back(*best);
    others.erase(best);
  }
  const CounterRandom random(seed, random_stream::covering_order);
  for (std::size_t i = cover.size(); i > 1; --i)  // Fisher-Yates
    std::swap(cover[i - 1], cover[static_cast<std::size_t>(random.uniform(i)[0] * double(i))]);
  cover.insert(cover.end(), others.begin(), others.end());
  return cover;
}

}  // namespace nextview

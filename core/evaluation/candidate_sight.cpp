#include "core/evaluation/candidate_sight.hpp"

#include <algorithm>

#include "core/evaluation/covering_order.hpp"

namespace nextview {

std::vector<std::uint8_t> CandidateSight::seen_by_any() const {
  std::vector<std::uint8_t> seen(sample_count);
  for (const auto& of_candidate : samples)
    for (const std::uint32_t s : of_candidate) seen[s] = 1;
  return seen;
}

std::size_t CandidateSight::visible_samples() const {
  const std::vector<std::uint8_t> seen = seen_by_any();
  return std::size_t(std::ranges::count(seen, 1));
}

std::vector<std::size_t> CandidateSight::covering_order(std::uint64_t seed) const {
  return nextview::covering_order(samples, sample_count, seed);
}

}  // namespace nextview

#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/view/pose.hpp"

namespace nextview {

/// Which samples of a surface each of some candidate views sees, by number, in ascending order.
struct CandidateSight {
  std::vector<Pose> candidates;
  std::vector<std::vector<std::uint32_t>> samples;  ///< of each candidate
  std::size_t sample_count = 0;                     ///< of the surface

  std::span<const std::uint32_t> seen_from(std::size_t candidate) const { return samples.at(candidate); }
  /// One a sample, 1: some candidate sees it.
  std::vector<std::uint8_t> seen_by_any() const;
  std::size_t visible_samples() const;
  /// The candidates in the order of a greedy set cover of the samples, the cover's own views shuffled, then the others.
  std::vector<std::size_t> covering_order(std::uint64_t seed) const;
};

}  // namespace nextview

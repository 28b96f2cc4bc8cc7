#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/gibbs/read_out.hpp"

namespace nextview {

/// Voxels with a known truth, of one case; what the read-out is fitted to.
struct ReadOutSamples {
  std::vector<ReadOutFeatures::Vector> features;
  std::vector<std::uint8_t> touch, centre;  ///< 1: occupied
  double weight = 1.0;                      ///< of their mean
};

/// Logistic regression by Newton's method: the weights of the least log loss, the weighted sum over the cases, each a
/// mean over its voxels. `truth`: ReadOutSamples::touch or ::centre. `used`: of each feature, whether it may have a
/// weight.
ReadOutFeatures::Vector fit_read_out(std::span<const ReadOutSamples> cases,
                                     std::vector<std::uint8_t> ReadOutSamples::*truth,
                                     const std::array<bool, ReadOutFeatures::count>& used);

}  // namespace nextview

#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/gibbs/read_out.hpp"

namespace nextview {

/// Voxels with a known truth, of one case; what the read-out is fitted to.
struct ReadOutSamples {
  std::vector<ReadOutFeatures::Vector> features;
  std::vector<float> touch, centre;  ///< 1: occupied, 0: not; what cannot be said lies between
  double weight = 1.0;               ///< of their mean
};

/// The network of little log loss, the weighted sum over the cases, each a mean over its voxels: by stochastic gradient
/// descent (Adam; Kingma and Ba 2015) over a few passes. `truth`: ReadOutSamples::touch or ::centre. `used`: of each
/// feature, whether it may have a weight. The same every time.
ReadOutNetwork fit_read_out(std::span<const ReadOutSamples> cases, std::vector<float> ReadOutSamples::*truth,
                            const std::array<bool, ReadOutFeatures::count>& used);

}  // namespace nextview

#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "core/gibbs/read_out.hpp"

namespace nextview {

/// Terms of the conventional map, fitted by `posterior_comparison --fit` to the same parts as the read-out.
struct CalibratedTerms {
  std::string_view sensor;     ///< EvidenceSensor::name
  std::string_view fitted_to;  ///< either truth, or the Gibbs map's probabilities of touch
  double hit, miss, clamp_min, clamp_max;
};
inline const std::vector<CalibratedTerms> calibrated_terms = {
    {"160x120, 5 mm", "touch", 0.9690, 0.2284, 0.0089, 0.9998},
    {"160x120, 5 mm", "centre", 0.7148, 0.1802, 0.0001, 0.8858},
    {"640x480, 2 mm", "touch", 0.9679, 0.1354, 0.0002, 0.9999},
    {"640x480, 2 mm", "centre", 0.6227, 0.1559, 0.0001, 0.7772},
};

/// The control: a read-out of the same form and fit that sees how many rays crossed a voxel and those around it and
/// how many ended there, and no posterior. What the Gibbs map is better by, the posterior adds.
inline const ReadOutWeights& read_out_of_rays_alone() {
  static const ReadOutWeights weights{
      {-1.7362, 0.0000, 0.0000, 0.0000,  0.0000, 0.0000, 0.0000,  0.0000,  0.0000, 0.0000,  0.0000, 0.0000,
       0.7897,  0.4581, 0.4408, -0.8271, 0.5246, 2.8148, -0.0999, -1.5943, 1.5778, -1.2105, 2.8697},
      {2.4380,  0.0000, 0.0000,  0.0000, 0.0000, 0.0000, 0.0000,  0.0000,  0.0000,  0.0000, 0.0000, 0.0000,
       -1.3234, 0.4561, -0.6445, 1.3643, 0.0403, 1.4719, -0.6692, -1.1973, -0.0984, 4.7586, 0.2397}};
  return weights;
}

}  // namespace nextview

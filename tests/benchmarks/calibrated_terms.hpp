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
    {"160x120, 5 mm", "touch", 0.9534, 0.2315, 0.0069, 0.9969},
    {"160x120, 5 mm", "centre", 0.6876, 0.1748, 0.0005, 0.8855},
    {"160x120, 5 mm", "posterior", 0.9566, 0.2210, 0.0124, 0.9974},
    {"640x480, 2 mm", "touch", 0.9382, 0.1505, 0.0001, 0.9948},
    {"640x480, 2 mm", "centre", 0.5908, 0.1493, 0.0001, 0.8093},
    {"640x480, 2 mm", "posterior", 0.9204, 0.1604, 0.0009, 0.9893},
};

/// The control: a read-out of the same form and fit that sees how many rays crossed a voxel and those around it and
/// how many ended there, and no posterior. What the Gibbs map is better by, the posterior adds.
inline const ReadOutWeights& read_out_of_rays_alone() {
  static const ReadOutWeights weights{
      {-4.1569, 0.0000,  0.0000, 0.0000, 0.0000,  0.0000,  0.0000,  0.0000, 0.0000,  0.0000,
       0.0000,  0.0000,  0.4308, 0.3210, 0.0934,  -0.9600, 0.5766,  2.6611, -0.2981, -0.6142,
       -0.1126, -0.8317, 2.1081, 5.1068, -1.7736, 0.0659,  -1.8500, -0.0391},
      {-3.3059, 0.0000, 0.0000,  0.0000,  0.0000, 0.0000,  0.0000,  0.0000,  0.0000,  0.0000,
       0.0000,  0.0000, -1.9774, -0.2164, 0.0431, 0.5312,  0.1881,  0.9471,  -0.1973, -0.4511,
       1.3198,  1.9035, 0.1678,  3.1433,  1.1940, -0.8876, -1.5499, -16.6907}};
  return weights;
}

}  // namespace nextview

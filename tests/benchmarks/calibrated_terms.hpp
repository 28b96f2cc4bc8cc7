#pragma once
#include <string_view>
#include <vector>

namespace nextview {

/// Terms of the conventional map, fitted by `posterior_comparison --fit` to the same parts as the read-out. To the
/// Gibbs map: as the read-out has it that the program was built with.
struct CalibratedTerms {
  std::string_view sensor;     ///< EvidenceSensor::name
  std::string_view fitted_to;  ///< either truth, or the Gibbs map's probabilities of touch
  double hit, miss, clamp_min, clamp_max;
};
inline const std::vector<CalibratedTerms> calibrated_terms = {
    {"160x120, 5 mm", "touch", 0.9534, 0.2315, 0.0069, 0.9969},
    {"160x120, 5 mm", "centre", 0.6876, 0.1748, 0.0005, 0.8855},
    {"160x120, 5 mm", "posterior", 0.9555, 0.2233, 0.0090, 0.9973},
    {"640x480, 2 mm", "touch", 0.9382, 0.1505, 0.0001, 0.9948},
    {"640x480, 2 mm", "centre", 0.5908, 0.1493, 0.0001, 0.8093},
    {"640x480, 2 mm", "posterior", 0.9317, 0.1526, 0.0005, 0.9924},
};

}  // namespace nextview

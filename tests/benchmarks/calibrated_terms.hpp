#pragma once
#include <string_view>
#include <vector>

namespace nextview {

/// Terms of the conventional map, fitted by `posterior_comparison --fit terms` to the same parts as the read-out. To
/// the Gibbs map: as the read-out has it that the program was built with.
struct CalibratedTerms {
  std::string_view sensor;     ///< EvidenceSensor::name
  std::string_view fitted_to;  ///< either truth, or the Gibbs map's probabilities of touch
  double hit, miss, clamp_min, clamp_max;
};
inline const std::vector<CalibratedTerms> calibrated_terms = {
    {"160x120, 5 mm", "touch", 0.9522, 0.2404, 0.0084, 0.9970},
    {"160x120, 5 mm", "centre", 0.7249, 0.1757, 0.0001, 0.8156},
    {"160x120, 5 mm", "posterior", 0.9539, 0.2380, 0.0085, 0.9972},
    {"640x480, 2 mm", "touch", 0.9317, 0.1604, 0.0004, 0.9966},
    {"640x480, 2 mm", "centre", 0.7196, 0.1263, 0.0001, 0.6079},
    {"640x480, 2 mm", "posterior", 0.9287, 0.1577, 0.0009, 0.9962},
};

}  // namespace nextview

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
    {"160x120, 5 mm", "touch", 0.9521, 0.2414, 0.0086, 0.9969},
    {"160x120, 5 mm", "centre", 0.6882, 0.1829, 0.0001, 0.8871},
    {"160x120, 5 mm", "posterior", 0.9541, 0.2380, 0.0086, 0.9960},
    {"640x480, 2 mm", "touch", 0.9324, 0.1613, 0.0006, 0.9965},
    {"640x480, 2 mm", "centre", 0.6085, 0.1542, 0.0001, 0.7486},
    {"640x480, 2 mm", "posterior", 0.9272, 0.1637, 0.0010, 0.9911},
};

}  // namespace nextview

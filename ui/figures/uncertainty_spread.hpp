#pragma once
#include <vector>

#include "core/surface/surface.hpp"

namespace nextview {

/// How the uncertainty of a surface is spread over its seen area: over the triangles whose three corners are seen, each
/// with the mean of its corners' uncertainty.
struct UncertaintySpread {
  double area_seen = 0.0, area_unseen = 0.0;  ///< [m^2]
  double median = 0.0, percentile_95 = 0.0;   ///< at most so much is uncertain of half, of 95 % of the area [m]
  double end = 0.0;                           ///< scale_end of the 99th percentile [m]
  std::vector<double> shares;                 ///< of the seen area in 50 equal bins from 0 to `end`
};

/// All 0 if nothing is seen, but for `end`.
UncertaintySpread uncertainty_spread(const Surface& surface);

}  // namespace nextview

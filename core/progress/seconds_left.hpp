#pragma once
#include <cmath>
#include <optional>

namespace nextview {

/// How long a job still takes if it goes on as it has so far, in whole seconds; none where that would be a mere guess,
/// or is too short to be told.
inline std::optional<double> seconds_left(double fraction, double elapsed) {
  if (fraction <= 0.02 || elapsed <= 1.0) return std::nullopt;
  return std::ceil(elapsed * (1 - fraction) / fraction);
}

}  // namespace nextview

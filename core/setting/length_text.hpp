#pragma once
#include <fmt/format.h>

#include <cmath>
#include <string>

namespace nextview {

/// A length [m] as people write it: in mm below a metre, to three digits, and whole metres in full.
inline std::string length_text(double length) {
  if (std::abs(length) >= 999.5) return fmt::format("{:.0f} m", length);
  return std::abs(length) < 0.9995 ? fmt::format("{:.3g} mm", 1e3 * length) : fmt::format("{:.3g} m", length);
}

}  // namespace nextview

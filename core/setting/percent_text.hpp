#pragma once
#include <fmt/format.h>

#include <string>

namespace nextview {

/// A share in percent as people write it: to two digits, and 99.7 as 100 instead of 1e+02.
inline std::string percent_text(double share) {
  const double percent = 100.0 * share;
  return percent < 99.5 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

}  // namespace nextview

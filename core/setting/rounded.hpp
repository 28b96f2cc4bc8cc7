#pragma once
#include <fmt/format.h>

#include <string>

namespace nextview {

/// To so many significant digits.
inline double rounded(double value, int digits) { return std::stod(fmt::format("{:.{}g}", value, digits)); }

}  // namespace nextview

#pragma once
#include <fmt/format.h>

#include <string>

namespace nextview {

/// An area as people write it, from one in cm²: in mm² below 0.1 cm², in m² from 10,000; to three digits, and whole
/// numbers in full. `largest` [cm²], where it stands beside others: the unit is that one's.
inline std::string area_text(double square_centimetres, double largest) {
  const bool is_large = largest >= 1e4, is_small = largest > 0.0 && largest < 0.1;
  const double area = (is_large ? 1e-4 : is_small ? 1e2 : 1.0) * square_centimetres;
  const char* unit = is_large ? "m²" : is_small ? "mm²" : "cm²";
  return area >= 99.95 ? fmt::format("{:.0f} {}", area, unit) : fmt::format("{:.3g} {}", area, unit);
}
inline std::string area_text(double square_centimetres) { return area_text(square_centimetres, square_centimetres); }

}  // namespace nextview

#pragma once
#include <fmt/format.h>

#include <string>

namespace nextview {

/// An area as people write it, from one in cm²: in mm² below 0.1 cm², in m² from 10,000; to three digits, and whole
/// numbers in full.
inline std::string area_text(double square_centimetres) {
  const auto text = [](double area, const char* unit) {
    return area >= 99.95 ? fmt::format("{:.0f} {}", area, unit) : fmt::format("{:.3g} {}", area, unit);
  };
  if (square_centimetres >= 1e4) return text(1e-4 * square_centimetres, "m²");
  const bool small = square_centimetres > 0.0 && square_centimetres < 0.1;
  return small ? text(1e2 * square_centimetres, "mm²") : text(square_centimetres, "cm²");
}

}  // namespace nextview

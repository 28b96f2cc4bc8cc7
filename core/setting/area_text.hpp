#pragma once
#include <fmt/format.h>

#include <string>

namespace nextview {

/// What people give an area in: mm² below 0.1 cm², m² from 10,000.
struct AreaUnit {
  const char* name;
  double per_square_centimetre;
};
inline AreaUnit area_unit(double square_centimetres) {
  if (square_centimetres >= 1e4) return {"m²", 1e-4};
  if (square_centimetres > 0.0 && square_centimetres < 0.1) return {"mm²", 1e2};
  return {"cm²", 1.0};
}

/// An area as people write it, from one in cm²: to three digits, and whole numbers in full. `beside` [cm²], what it
/// stands beside: the unit is that one's.
inline std::string area_text(double square_centimetres, double beside) {
  const AreaUnit unit = area_unit(beside);
  const double area = unit.per_square_centimetre * square_centimetres;
  return area >= 99.95 ? fmt::format("{:.0f} {}", area, unit.name) : fmt::format("{:.3g} {}", area, unit.name);
}
inline std::string area_text(double square_centimetres) { return area_text(square_centimetres, square_centimetres); }

}  // namespace nextview

#pragma once
#include <string>

namespace nextview {

/// What a number may be. Not a number it never is.
struct Bounds {
  double low = 0.0, high = 0.0;
  bool low_included = true, high_included = true;
  bool or_zero = false;  ///< 0 as well: off, or chosen by the program

  bool allow(double value) const;
  /// "from 0.2 to 5 s", "over 0 and below 1"; a length with a unit that suits it: "from 0.01 mm to 1 m"
  std::string text(const std::string& unit = "") const;
};

constexpr Bounds from_to(double low, double high) { return {low, high}; }
constexpr Bounds between(double low, double high) { return {low, high, false, false}; }
constexpr Bounds over_to(double low, double high) { return {low, high, false, true}; }
constexpr Bounds zero_or(double low, double high) { return {low, high, true, true, true}; }

}  // namespace nextview

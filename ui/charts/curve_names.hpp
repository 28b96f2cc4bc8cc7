#pragma once
#include <span>
#include <string>

#include "ui/drawing/painter.hpp"

namespace nextview {

struct CurveName {
  std::string name;
  Colour colour;
};

/// In rows from `top` down, each name beside a piece of its curve; those without a name are left out. Returns the rows'
/// height [px].
double paint_curve_names(Painter& painter, double left, double top, double width, std::span<const CurveName> names);

/// The piece of a curve, and the room between it and its name [px].
inline constexpr double curve_sample = 20, curve_sample_gap = 8;

}  // namespace nextview

#include "ui/window/layout.hpp"

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

// [px] on a display that does not scale
constexpr double bar_height = 56, status_height = 30, left_width = 268, right_width = 336, session_height = 306;
constexpr double curves_height = 218;
/// Panels are this far apart: a hairline, in the colour behind them.
constexpr double gap = 1;

}  // namespace

Viewport Rectangle::in(int surface_width, int surface_height) const {
  return {x / surface_width, 1 - (y + height) / surface_height, (x + width) / surface_width, 1 - y / surface_height};
}

Layout::Layout(int width, int height, double scale) {
  const auto px = [&](double length) { return std::round(length * scale); };
  const auto rest = [](double length) { return std::max(length, 1.0); };
  const double top = px(bar_height) + gap, bottom = rest(height - px(status_height) - gap);
  const double left = px(left_width) + gap, right = rest(width - px(right_width) - gap);
  const double lower = rest(bottom - px(curves_height));
  control_bar = {0, 0, double(width), px(bar_height)};
  status = {0, height - px(status_height), double(width), px(status_height)};
  session = {0, top, px(left_width), px(session_height)};
  layers = {0, top + px(session_height) + gap, px(left_width), rest(bottom - top - px(session_height) - gap)};
  candidates = {right + gap, top, px(right_width), rest(bottom - top)};
  scene = {left, top, rest(right - left), rest(lower - gap - top)};
  curves = {left, lower, rest(right - left), rest(bottom - lower)};
}

}  // namespace nextview

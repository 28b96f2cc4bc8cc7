#include "ui/window/layout.hpp"

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

// [px] on a display that does not scale
constexpr double menu_height = 27, bar_height = 50, status_height = 26, left_width = 272, right_width = 336;
constexpr double bottom_height = 236;
/// Panels are this far apart: a hairline, in the colour behind them.
constexpr double gap = 1;

}  // namespace

Viewport Rectangle::in(int surface_width, int surface_height) const {
  return {x / surface_width, 1 - (y + height) / surface_height, (x + width) / surface_width, 1 - y / surface_height};
}

Layout::Layout(int width, int height, double scale) {
  const auto px = [&](double length) { return std::round(length * scale); };
  const auto rest = [](double length) { return std::max(length, 1.0); };
  const double bar_top = px(menu_height) + gap, top = bar_top + px(bar_height) + gap;
  const double end = rest(height - px(status_height) - gap);
  const double begin_x = px(left_width) + gap, end_x = rest(width - px(right_width) - gap);
  const double lower = rest(end - px(bottom_height));
  menu = {0, 0, double(width), px(menu_height)};
  control_bar = {0, bar_top, double(width), px(bar_height)};
  status = {0, height - px(status_height), double(width), px(status_height)};
  left = {0, top, px(left_width), rest(end - top)};
  right = {end_x + gap, top, px(right_width), rest(end - top)};
  scene = {begin_x, top, rest(end_x - begin_x), rest(lower - gap - top)};
  bottom = {begin_x, lower, rest(end_x - begin_x), rest(end - lower)};
}

}  // namespace nextview

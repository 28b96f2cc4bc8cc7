#include "ui/panels/layout.hpp"

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

// [px] on a display that does not scale
constexpr double menu_height = 27, bar_height = 50, status_height = 26;
/// Panels are this far apart: a hairline, in the colour behind them.
constexpr double gap = 1;
/// With less than this for the scene, panels are folded [px].
constexpr double min_scene_width = 300, min_scene_height = 160;
/// With less than this between menu and status line, there is neither control bar nor status line [px].
constexpr double min_middle = 130;
/// Of the window's width that a column takes at most, where there is one.
constexpr double widest_column = 0.55;

}  // namespace

Viewport Rectangle::in(int surface_width, int surface_height) const {
  return {x / surface_width, 1 - (y + height) / surface_height, (x + width) / surface_width, 1 - y / surface_height};
}

double Layout::largest_scale(int w, int h) {
  const double for_buttons = std::min(w / 332.0, h / (menu_height + bar_height + status_height + min_middle + 6 * gap));
  const double for_panels = std::min(w / 480.0, h / 400.0);  // each still shows its first table or plot
  return std::min(for_buttons, std::max(for_panels, 1.25));  // a little larger at any rate
}

Layout::Layout(int w, int h, double scale, Side open, const PlaceSizes& sizes) : width(w), height(h), open_(open) {
  const auto px = [&](double length) { return std::round(length * scale); };
  menu = {0, 0, width, std::min(px(menu_height), height)};
  double top = menu.height + gap, end = height;
  if (end - top - px(status_height) - gap >= px(min_middle)) {
    end -= px(status_height) + gap;
    status = {0, end + gap, width, px(status_height)};
  }
  if (end - top - px(bar_height) - gap >= px(min_middle)) {
    control_bar = {0, top, width, px(bar_height)};
    top += control_bar.height + gap;
  }
  const double middle = std::max(end - top, 0.0);
  // Whether there is room goes by the usual sizes: others have what is left of it.
  constexpr PlaceSizes usual;
  left_folded = width < px(usual.left) + px(usual.right) + px(min_scene_width) + 2 * gap;
  bottom_folded = middle < px(usual.lower) + px(min_scene_height) + gap;
  const double beside = width - px(min_scene_width) - 2 * gap, share = sizes.left / (sizes.left + sizes.right);
  const double left_width = std::min(px(sizes.left), std::max(beside - px(sizes.right), std::floor(share * beside)));
  const double right_width = std::min(px(sizes.right), beside - left_width);
  const double bottom_height = std::min(px(sizes.lower), middle - px(min_scene_height) - gap);

  const double column = left_folded ? std::min(px(usual.right), std::floor(widest_column * width)) : right_width;
  const double begin_x = left_folded ? 0 : left_width + gap, end_x = std::max(width - column - gap, begin_x);
  const double lower = bottom_folded ? end : end - bottom_height;
  scene = {begin_x, top, end_x - begin_x, std::max(lower - (bottom_folded ? 0 : gap) - top, 0.0)};
  if (!left_folded) left = {0, top, left_width, middle};
  if (!bottom_folded) bottom = {begin_x, lower, end_x - begin_x, end - lower};
  fold({end_x + gap, top, column, middle}, px(tabs_height));
}

Layout Layout::with_captions(int w, int h, double scale, Side open, const PlaceSizes& sizes) {
  const int strip = std::min(int(std::round(caption_height * scale)), h);
  Layout layout(w, h - strip, scale, open, sizes);
  layout.height = h;
  layout.captions = {0, double(h - strip), layout.width, double(strip)};
  return layout;
}

void Layout::hide_panels(bool menu_too) {
  control_bar = left = right = bottom = status = {};
  if (menu_too) menu.height = 0;
  const double top = menu.height > 0 ? menu.height + gap : 0.0;
  scene = {0, top, width, std::max(height - captions.height - top, 0.0)};
}

/// Those that are folded and the right place, one above the other; all but one are a row of tabs.
void Layout::fold(const Rectangle& column, double tabs) {
  if (!is_in_column(open_)) open_ = Side::right;
  const int closed = int(left_folded) + int(bottom_folded);
  const double row = std::min(tabs, std::floor(column.height / (closed + 2)));
  double y = column.y;
  const auto place = [&](Side side) {
    const Rectangle rectangle{column.x, y, column.width, side == open_ ? column.height - closed * row : row};
    y += rectangle.height;
    return rectangle;
  };
  if (left_folded) left = place(Side::left);
  right = place(Side::right);
  if (bottom_folded) bottom = place(Side::bottom);
}

}  // namespace nextview

#pragma once
#include "ui/scene.hpp"
#include "ui/window/window_state.hpp"

namespace nextview {

/// Framebuffer pixels from the upper left corner.
struct Rectangle {
  double x = 0, y = 0, width = 0, height = 0;

  bool contains(double px, double py) const { return px >= x && py >= y && px < x + width && py < y + height; }
  Viewport in(int surface_width, int surface_height) const;
};

/// Where everything in the window is. Panels of a side share a place, with tabs at its top; the scene has what is left.
struct Layout {
  Rectangle menu, control_bar, left, right, bottom, scene, status;

  /// Made for 1280 x 800 pixels and more; `scale` is the display's.
  Layout(int width, int height, double scale);

  const Rectangle& of(Side side) const { return side == Side::left ? left : side == Side::right ? right : bottom; }
};

}  // namespace nextview

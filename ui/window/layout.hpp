#pragma once
#include "ui/scene.hpp"

namespace nextview {

/// Framebuffer pixels from the upper left corner.
struct Rectangle {
  double x = 0, y = 0, width = 0, height = 0;

  bool contains(double px, double py) const { return px >= x && py >= y && px < x + width && py < y + height; }
  Viewport in(int surface_width, int surface_height) const;
};

/// Where everything in the window is. The scene and the curves have what the panels leave free.
struct Layout {
  Rectangle control_bar, session, layers, candidates, scene, curves, status;

  /// Made for 1280 x 800 pixels and more; `scale` is the display's.
  Layout(int width, int height, double scale);
};

}  // namespace nextview

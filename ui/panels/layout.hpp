#pragma once
#include "ui/commands/window_state.hpp"
#include "ui/drawing/viewport.hpp"

namespace nextview {

/// Framebuffer pixels from the upper left corner.
struct Rectangle {
  double x = 0, y = 0, width = 0, height = 0;

  bool operator==(const Rectangle&) const = default;
  bool empty() const { return width < 1 || height < 1; }
  bool contains(double px, double py) const { return px >= x && py >= y && px < x + width && py < y + height; }
  Viewport in(int surface_width, int surface_height) const;
};

/// Where everything in the window is. Panels of a side share a place, with tabs at its top; the scene has what is left.
/// Where there is no room for all of it, places are folded: the left, and in a low window the lower one, become rows of
/// tabs in the right one's column, of which one place is open; then the control bar and the status line go (empty).
struct Layout {
  Rectangle menu, control_bar, left, right, bottom, scene, status;
  Rectangle captions;                               ///< of a demo, beneath all else; empty without one
  double width = 0, height = 0;                     ///< of the window
  bool left_folded = false, bottom_folded = false;  ///< into the column at the right

  /// Of a window of any size [px]; `scale` is the display's. `open` is the place that is open where they are folded.
  Layout(int width, int height, double scale, Side open = Side::right, const PlaceSizes& sizes = {});

  /// Of a window of this size [px], in which the control bar shows all its buttons, and where that leaves
  /// text large enough, panels what they are for.
  static double largest_scale(int width, int height);

  /// With a strip for captions beneath all else, as wide as the window.
  static Layout with_captions(int width, int height, double scale, Side open, const PlaceSizes& sizes = {});

  /// Gives the scene all but the menu, or also the menu's place.
  void hide_panels(bool menu_too = false);

  static constexpr double tabs_height = 32, caption_height = 68;  ///< [px] on a display that does not scale

  const Rectangle& of(Side side) const { return side == Side::left ? left : side == Side::right ? right : bottom; }

  /// Whether the side's panels are shown, not only their tabs.
  bool is_open(Side side) const { return side == open_ || !is_in_column(side); }

 private:
  bool is_in_column(Side side) const { return side == Side::left ? left_folded : side == Side::right || bottom_folded; }
  void fold(const Rectangle& column, double tabs);

  Side open_;  ///< of those in the column
};

}  // namespace nextview

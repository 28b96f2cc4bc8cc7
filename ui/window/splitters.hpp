#pragma once
#include <optional>

#include "ui/panels/panel.hpp"

namespace nextview {

/// The borders of the panels' places, which the mouse drags; a double click gives a place its usual size.
class Splitters {
 public:
  /// After the panels, whose windows would take the mouse else.
  void draw(const PanelContext& context, const Layout& layout);

 private:
  /// `now`: the width or height of its place [px].
  void draw_border(const PanelContext& context, Side side, const Rectangle& border, double now);

  std::optional<double> start_;  ///< of what is dragged: its size when the drag began [px]
};

}  // namespace nextview

#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// The panels of a side, as tabs at the top of its place, or as a list where they would not fit; returns the rectangle
/// that is left beneath them. Of a place that is not `open` they are all there is, and none is in front.
Rectangle draw_tabs(const PanelContext& context, Side side, const Rectangle& rectangle, bool open = true);

}  // namespace nextview

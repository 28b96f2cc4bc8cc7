#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// Step, play, undo, start over; what the worker is doing, with a way to stop it; how far the scan is.
void draw_control_bar(const PanelContext& context, const Rectangle& rectangle);

}  // namespace nextview

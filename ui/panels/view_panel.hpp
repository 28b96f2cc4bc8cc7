#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// The view that is looked at: what the camera sees or is expected to see, which rays are worth what, what the gain was
/// said to be and what came of it.
void draw_view_panel(const PanelContext& context, const Rectangle& rectangle);

}  // namespace nextview

#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// All keys and what the mouse does, over the middle of the window.
void draw_shortcut_sheet(const PanelContext& context, const Rectangle& window);

}  // namespace nextview

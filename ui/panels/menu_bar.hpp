#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// All commands, menu by menu.
void draw_menu_bar(const PanelContext& context, const Rectangle& rectangle);

}  // namespace nextview

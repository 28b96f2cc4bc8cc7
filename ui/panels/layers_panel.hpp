#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// What the scene shows, and how.
void draw_layers_panel(const PanelContext& context, const Rectangle& rectangle);

}  // namespace nextview

#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// Entropy and surface coverage over the views.
void draw_curves_panel(const PanelContext& context, const Rectangle& rectangle);

}  // namespace nextview

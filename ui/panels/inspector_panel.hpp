#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// The voxel or the ray that was picked: why it is as it is.
void draw_inspector_panel(const PanelContext& context, const Rectangle& rectangle);

}  // namespace nextview

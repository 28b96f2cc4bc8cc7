#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// What to do first, in three lines above the scene: until a view is taken, or the user has read it.
void draw_guide(const PanelContext& context, const Rectangle& scene);

}  // namespace nextview

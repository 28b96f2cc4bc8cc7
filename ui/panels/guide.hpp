#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// What to do first with what is open, in three lines above the scene: until a view is taken, or the user has read it,
/// and whenever it is asked for.
void draw_guide(const PanelContext& context, const Rectangle& scene);

}  // namespace nextview

#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// The ranking: what each candidate view is worth, which one is next and why. The user can take another one.
void draw_candidates_panel(const PanelContext& context, const Rectangle& rectangle);

}  // namespace nextview

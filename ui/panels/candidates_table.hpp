#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// The candidates with their numbers as bars, in the order that the user sorted them by; a click selects one.
/// `height` [px]
void draw_candidates_table(const PanelContext& context, float height);

}  // namespace nextview

#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// What the last step did, or why the last command failed; at the right what is being scanned.
void draw_status_line(const PanelContext& context, const Rectangle& rectangle);

}  // namespace nextview

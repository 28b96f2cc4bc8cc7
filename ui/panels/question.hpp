#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// What a job waits for an answer to, over the scene; nothing if it does not.
void draw_question(const PanelContext& context, const Rectangle& scene);

}  // namespace nextview

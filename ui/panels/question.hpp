#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// A question about a scan covers no more of the scene, at its lower end [px on a display that does not scale].
constexpr float question_height = 180;

/// What a job waits for an answer to, over the scene; nothing if it does not.
void draw_question(const PanelContext& context, const Rectangle& scene);

}  // namespace nextview

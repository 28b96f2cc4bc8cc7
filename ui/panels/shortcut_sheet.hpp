#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// All keys and what the mouse does, over the middle of the scene. `open` becomes false when it is closed.
void draw_shortcut_sheet(const Style& style, const Rectangle& scene, bool& open);

}  // namespace nextview

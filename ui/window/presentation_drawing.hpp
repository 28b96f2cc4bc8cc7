#pragma once
#include "ui/commands/presentation.hpp"
#include "ui/panels/layout.hpp"
#include "ui/panels/style.hpp"

namespace nextview {

/// What a demo shows over the window: the caption at the scene's lower end, the frame around a panel, the title.
void draw_presentation(const Style& style, const Presentation& presentation, const Layout& layout);

}  // namespace nextview

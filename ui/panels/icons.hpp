#pragma once
#include <imgui.h>

namespace nextview {

enum class Icon { none, step, play, pause, reset, cancel, warning, undo, redo };

/// Draws an icon into a square.
void draw_icon(Icon icon, ImVec2 centre, float size, ImU32 colour);

}  // namespace nextview

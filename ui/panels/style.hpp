#pragma once
#include <imgui.h>

#include "ui/appearance/theme.hpp"

namespace nextview {

/// The panels' fonts, and how many pixels a length of one has on this display.
struct Style {
  ImFont* regular = nullptr;
  ImFont* semi_bold = nullptr;
  ImFont* small = nullptr;
  ImFont* caption = nullptr;  ///< of demos, as the next: read from far away; Latin letters only
  ImFont* title = nullptr;
  float scale = 1.0f;

  float px(float length) const { return length * scale; }
};

/// Gives ImGui's current context the product's look. `scale` is the display's.
/// @throws std::runtime_error naming the package to install if the font is not there.
Style apply_style(float scale);

/// Gives ImGui's current context its colours, on white paper or on dark.
void set_colours(bool dark);
/// Whether they are on dark paper.
bool is_dark();

/// A colour of the theme as panels show it: on dark paper turned over (on_dark).
ImVec4 to_imgui(const Colour& colour, double opacity = 1.0);
ImU32 to_imgui_u32(const Colour& colour, double opacity = 1.0);
/// The same where it names a colour of the scene, which has it as it is.
ImU32 scene_colour_u32(const Colour& colour);

}  // namespace nextview

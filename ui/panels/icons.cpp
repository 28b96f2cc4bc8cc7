#include "ui/panels/icons.hpp"

#include <cmath>

#include "ui/panels/style.hpp"

namespace nextview {
namespace {

void draw_reset(ImDrawList& list, ImVec2 c, float r, ImU32 colour) {
  constexpr float start = -0.9f, end = 4.1f;  // [rad] an open circle with an arrow head
  list.PathArcTo(c, r * 0.85f, start, end, 24);
  list.PathStroke(colour, 0, r * 0.28f);
  const ImVec2 tip(c.x + r * 0.85f * std::cos(start), c.y + r * 0.85f * std::sin(start));
  list.AddTriangleFilled({tip.x - 0.62f * r, tip.y - 0.18f * r}, {tip.x + 0.42f * r, tip.y - 0.52f * r},
                         {tip.x + 0.28f * r, tip.y + 0.52f * r}, colour);
}

/// An arrow that turns back; `x` is the half width, negative for its mirror image.
void draw_turn(ImDrawList& list, ImVec2 c, float x, float r, ImU32 colour) {
  list.PathLineTo({c.x - 0.6f * x, c.y - 0.35f * r});
  list.PathBezierCubicCurveTo({c.x + 1.5f * x, c.y - 0.55f * r}, {c.x + 1.3f * x, c.y + 0.95f * r},
                              {c.x - 0.3f * x, c.y + 0.8f * r}, 12);
  list.PathStroke(colour, 0, r * 0.28f);
  list.AddTriangleFilled({c.x - 1.1f * x, c.y - 0.35f * r}, {c.x - 0.3f * x, c.y - 0.95f * r},
                         {c.x - 0.3f * x, c.y + 0.25f * r}, colour);
}

}  // namespace

void draw_icon(Icon icon, ImVec2 c, float size, ImU32 colour) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float r = size / 2;
  if (icon == Icon::reset) return draw_reset(list, c, r, colour);
  if (icon == Icon::undo || icon == Icon::redo) return draw_turn(list, c, icon == Icon::undo ? r : -r, r, colour);
  if (icon == Icon::play || icon == Icon::step) {
    const float shift = icon == Icon::step ? -0.25f * r : 0.1f * r;
    list.AddTriangleFilled({c.x - 0.7f * r + shift, c.y - r}, {c.x - 0.7f * r + shift, c.y + r},
                           {c.x + 0.9f * r + shift, c.y}, colour);
  }
  if (icon == Icon::step) list.AddRectFilled({c.x + 0.7f * r, c.y - r}, {c.x + r, c.y + r}, colour);
  if (icon == Icon::pause) {
    list.AddRectFilled({c.x - 0.8f * r, c.y - r}, {c.x - 0.2f * r, c.y + r}, colour);
    list.AddRectFilled({c.x + 0.2f * r, c.y - r}, {c.x + 0.8f * r, c.y + r}, colour);
  }
  if (icon == Icon::cancel) {
    list.AddLine({c.x - 0.7f * r, c.y - 0.7f * r}, {c.x + 0.7f * r, c.y + 0.7f * r}, colour, 0.3f * r);
    list.AddLine({c.x - 0.7f * r, c.y + 0.7f * r}, {c.x + 0.7f * r, c.y - 0.7f * r}, colour, 0.3f * r);
  }
  if (icon == Icon::warning) {
    list.AddTriangleFilled({c.x - r, c.y + 0.85f * r}, {c.x + r, c.y + 0.85f * r}, {c.x, c.y - 0.9f * r}, colour);
    const ImU32 mark = to_imgui_u32(theme::paper);
    list.AddLine({c.x, c.y - 0.35f * r}, {c.x, c.y + 0.3f * r}, mark, 0.24f * r);
    list.AddCircleFilled({c.x, c.y + 0.58f * r}, 0.15f * r, mark, 8);
  }
}

}  // namespace nextview

#include "ui/window/overlay_drawing.hpp"

#include <cfloat>

namespace nextview {

void draw_label(const Style& style, ImVec2 place, const std::string& text, const Colour& colour) {
  const ImVec2 size = style.semi_bold->CalcTextSizeA(style.semi_bold->FontSize, FLT_MAX, 0, text.c_str());
  const ImVec2 corner(place.x + style.px(10), place.y - size.y - style.px(6));
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({corner.x - style.px(5), corner.y - style.px(2)},
                     {corner.x + size.x + style.px(5), corner.y + size.y + style.px(2)},
                     to_imgui_u32(theme::paper, 0.85), style.px(3));
  list.AddText(style.semi_bold, style.semi_bold->FontSize, corner, to_imgui_u32(colour), text.c_str());
}

void draw_segment(SceneView& view, const Vector3& from, const Vector3& to, ImU32 colour, float width) {
  const auto a = view.project(from), b = view.project(to);
  if (a && b) ImGui::GetBackgroundDrawList()->AddLine(at(*a), at(*b), colour, width);
}

}  // namespace nextview

#include "ui/window/overlay_drawing.hpp"

#include <algorithm>
#include <cfloat>

namespace nextview {

Rectangle draw_label(const Style& style, ImVec2 place, const std::string& text, const Colour& colour,
                     const Rectangle* inside) {
  const float border = style.px(8), wide = inside ? float(inside->width) - 2 * border : 0.0f;  // 0: as it is
  const float height = style.semi_bold->FontSize;
  const ImVec2 size = style.semi_bold->CalcTextSizeA(height, FLT_MAX, wide, text.c_str());
  ImVec2 corner(place.x + style.px(10), place.y - size.y - style.px(6));
  if (inside) {
    const float right = float(inside->x + inside->width), bottom = float(inside->y + inside->height);
    corner.x = std::max(std::min(corner.x, right - size.x - border), float(inside->x) + border);
    corner.y = std::max(std::min(corner.y, bottom - size.y - border), float(inside->y) + border);
  }
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({corner.x - style.px(5), corner.y - style.px(2)},
                     {corner.x + size.x + style.px(5), corner.y + size.y + style.px(2)},
                     to_imgui_u32(theme::paper, 0.85), style.px(3));
  list.AddText(style.semi_bold, height, corner, to_imgui_u32(colour), text.c_str(), nullptr, wide);
  return {corner.x - style.px(5), corner.y - style.px(2), size.x + style.px(10), size.y + style.px(4)};
}

void draw_led_label(const Style& style, ImVec2 place, const std::string& text, const Colour& colour,
                    const Rectangle& inside) {
  const float away = style.px(26);
  const Rectangle box = draw_label(style, {place.x + away, place.y - away}, text, colour, &inside);
  const ImVec2 nearest(std::clamp(place.x, float(box.x), float(box.x + box.width)),
                       std::clamp(place.y, float(box.y), float(box.y + box.height)));
  ImGui::GetBackgroundDrawList()->AddLine(place, nearest, to_imgui_u32(colour), style.px(1));
}

void draw_beside_legends(const SceneView& view, const std::function<void()>& draw) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const Rectangle& r : view.beside_legends()) {
    if (r.empty()) continue;
    list.PushClipRect({float(r.x), float(r.y)}, {float(r.x + r.width), float(r.y + r.height)});
    draw();
    list.PopClipRect();
  }
}

void draw_segment(SceneView& view, const Vector3& from, const Vector3& to, ImU32 colour, float width) {
  const auto a = view.project(from), b = view.project(to);
  if (a && b) ImGui::GetBackgroundDrawList()->AddLine(at(*a), at(*b), colour, width);
}

}  // namespace nextview

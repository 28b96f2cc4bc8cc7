#include "ui/window/splitters.hpp"

#include <algorithm>
#include <cmath>

#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

constexpr float grip = 6;  ///< across a border, of what takes the mouse [px] on a display that does not scale

double& size_of(PlaceSizes& sizes, Side side) {
  return side == Side::left ? sizes.left : side == Side::right ? sizes.right : sizes.lower;
}

}  // namespace

void Splitters::draw(const PanelContext& context, const Layout& layout) {
  if (layout.left_folded || layout.scene.empty() || layout.left.empty()) return;
  const double half = std::floor(context.style.px(grip) / 2);
  const Rectangle &l = layout.left, &r = layout.right, &b = layout.bottom;
  draw_border(context, Side::left, {layout.scene.x - half, l.y, 2 * half, l.height}, l.width);
  draw_border(context, Side::right, {r.x - half, r.y, 2 * half, r.height}, r.width);
  if (!layout.bottom_folded) draw_border(context, Side::bottom, {b.x, b.y - half, b.width, 2 * half}, b.height);
}

void Splitters::draw_border(const PanelContext& context, Side side, const Rectangle& border, double now) {
  if (border.width < 1 || border.height < 1) return;
  const char* name = side == Side::left ? "##left border" : side == Side::right ? "##right border" : "##lower border";
  ImGui::SetNextWindowPos({float(border.x), float(border.y)});
  ImGui::SetNextWindowSize({float(border.width), float(border.height)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  ImGui::InvisibleButton(name, {float(border.width), float(border.height)});
  PlaceSizes sizes = context.window.place_sizes;
  double& size = size_of(sizes, side);
  const auto post = [&] { context.post(command::panel_sizes(sizes.left, sizes.right, sizes.lower)); };
  if (ImGui::IsItemHovered() || ImGui::IsItemActive())
    ImGui::SetMouseCursor(side == Side::bottom ? ImGuiMouseCursor_ResizeNS : ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    PlaceSizes usual;
    size = size_of(usual, side);
    post();
  } else if (ImGui::IsItemActivated()) {
    start_ = now / context.style.scale;
  } else if (ImGui::IsItemActive() && start_) {
    const ImVec2 by = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0);
    const double moved = side == Side::left ? by.x : side == Side::right ? -by.x : -by.y;
    const double wanted =
        std::clamp(std::round(*start_ + moved / context.style.scale), PlaceSizes::smallest, PlaceSizes::largest);
    if (wanted != size) {
      size = wanted;
      post();
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace nextview

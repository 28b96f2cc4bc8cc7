#include "ui/panels/tabs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "ui/commands/window_commands.hpp"

namespace nextview {

namespace {

/// What the panel is, and its key.
std::string help_of(const PanelInfo& panel) {
  for (const Shortcut& shortcut : command::panel.shortcuts())
    if (shortcut.values.front() == panel.name) return fmt::format("{} [{}]", panel.help, shortcut.text());
  return panel.help;
}

/// One tab; returns where the next begins.
float draw_tab(const PanelContext& context, const PanelInfo& which, bool front, float x, float height) {
  const Style& style = context.style;
  ImFont* font = front ? style.semi_bold : style.regular;
  const char* title = which.title.c_str();
  const float width = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, title).x + style.px(16);
  ImGui::SetCursorPos({x, 0});
  if (ImGui::InvisibleButton(title, {width, height})) context.post(command::panel(which.name));
  tooltip(help_of(which));
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const Colour colour = front || ImGui::IsItemHovered() ? theme::ink : theme::soft_ink;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(font, font->FontSize, {from.x + style.px(8), from.y + style.px(7)}, to_imgui_u32(colour), title);
  if (front)
    list.AddRectFilled({from.x + style.px(8), to.y - style.px(3)}, {to.x - style.px(8), to.y - style.px(1)},
                       to_imgui_u32(theme::series[0]));
  return x + width;
}

/// Instead of tabs, where they would not fit.
void draw_tab_list(const PanelContext& context, std::span<const PanelInfo* const> panels, const PanelInfo& front,
                   float width) {
  ImGui::SetCursorPos({context.style.px(4), context.style.px(3)});
  ImGui::SetNextItemWidth(width - context.style.px(8));
  if (!ImGui::BeginCombo("##panels", front.title.c_str())) return;
  for (const PanelInfo* panel : panels)
    if (ImGui::Selectable(panel->title.c_str(), panel == &front)) context.post(command::panel(panel->name));
  ImGui::EndCombo();
}

}  // namespace

Rectangle draw_tabs(const PanelContext& context, Side side, const Rectangle& r, bool open) {
  const Style& style = context.style;
  const float height = std::min(style.px(float(Layout::tabs_height)), float(r.height));
  std::vector<const PanelInfo*> panels;
  float wide = style.px(12);
  for (const PanelInfo& panel : panel_list()) {
    if (panel.side != side) continue;
    panels.push_back(&panel);
    wide += style.semi_bold->CalcTextSizeA(style.semi_bold->FontSize, FLT_MAX, 0, panel.title.c_str()).x + style.px(16);
  }
  const std::string name = fmt::format("Tabs {}", static_cast<int>(side));
  const Panel panel(name.c_str(), {r.x, r.y, r.width, height}, ImGuiWindowFlags_NoScrollbar);
  const PanelInfo& front = panel_info(context.window.in_front(side));
  if (wide > float(r.width)) {
    draw_tab_list(context, panels, front, float(r.width));
  } else {
    float x = style.px(6);
    for (const PanelInfo* which : panels) x = draw_tab(context, *which, open && which == &front, x, height);
  }
  return {r.x, r.y + height, r.width, r.height - height};
}

}  // namespace nextview

#include "ui/panels/menu_bar.hpp"

#include "ui/commands/command_list.hpp"

namespace nextview {
namespace {

void draw_menu(const PanelContext& context, const std::string& menu) {
  for (const Command& command : commands()) {
    if (command.menu != menu) continue;
    const bool on = command.on && command.on(context.window);
    if (ImGui::MenuItem(command.text.c_str(), command.keys().c_str(), on, command.available(context.state())))
      context.invoke(command);
    tooltip(help_of(context, command));
  }
}

}  // namespace

void draw_menu_bar(const PanelContext& context, const Rectangle& rectangle) {
  const Style& style = context.style;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(style.px(8), style.px(5)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(6), 0));
  const Panel panel("Menu", rectangle, ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleVar(2);
  if (!ImGui::BeginMenuBar()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(10), style.px(8)));
  for (const std::string& menu : menus()) {
    if (!ImGui::BeginMenu(menu.c_str())) continue;
    draw_menu(context, menu);
    ImGui::EndMenu();
  }
  ImGui::PopStyleVar();
  ImGui::EndMenuBar();
}

}  // namespace nextview

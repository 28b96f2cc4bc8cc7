#include "ui/panels/shortcut_sheet.hpp"

#include <array>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "ui/commands/command_list.hpp"
#include "ui/commands/panel_list.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

constexpr std::array mouse = {
    std::pair{"Left drag", "turn the scene"},
    std::pair{"Middle or Shift + left drag", "move it"},
    std::pair{"Wheel", "nearer to the pointer, farther"},
    std::pair{"Double click", "bring this point to the middle"},
    std::pair{"Arrows, =, −", "turn, nearer, farther"},
    std::pair{"Tab, arrows, Enter", "go through the controls, press one"},
    std::pair{"Click a frustum", "look at this view"},
    std::pair{"Click a voxel", "inspect it"},
    std::pair{"Click a ray", "inspect it"},
    std::pair{"Point at a candidate", "see its frustum"},
    std::pair{"Drop a file", "open it: object, scans, map, .toml"},
};

void draw_row(std::string_view keys, std::string_view help) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(keys.data(), keys.data() + keys.size());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(help.data(), help.data() + help.size());
}

void draw_heading(const Style& style, const char* text) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::Dummy({0, style.px(4)});
  heading(style, text);
}

/// The keys that give a command a value: "A" "Frame: all", "Ctrl+1…7" "Look from a side". Numbers are told with
/// the mouse.
void draw_valued(const Command& command) {
  std::vector<const Shortcut*> named;
  const auto shortcuts = command.shortcuts();
  for (const Shortcut& shortcut : shortcuts)
    if (shortcut.values.size() == 1 && std::isalpha(static_cast<unsigned char>(shortcut.values.front().front())))
      named.push_back(&shortcut);
  const std::string text = command.text.substr(0, command.text.find("…"));
  if (named.size() > 3) return draw_row(named.front()->text() + "…" + named.back()->text().back(), text);
  for (const Shortcut* shortcut : named) draw_row(shortcut->text(), text + ": " + shortcut->values.front());
}

/// The keys of some menus' commands, menu by menu.
void draw_menus(const PanelContext& context, std::initializer_list<const char*> wanted) {
  if (!ImGui::BeginTable(*wanted.begin(), 2, ImGuiTableFlags_SizingFixedFit)) return;
  for (const char* menu : wanted) {
    draw_heading(context.style, menu);
    for (const Command& command : commands()) {
      if (command.menu != menu || &command == &command::panel) continue;  // panels have a heading of their own
      if (const std::string keys = command.keys(); !keys.empty()) draw_row(keys, command.text);
      draw_valued(command);
    }
  }
  ImGui::EndTable();
}

void draw_panels_and_mouse(const PanelContext& context) {
  if (!ImGui::BeginTable("panels and mouse", 2, ImGuiTableFlags_SizingFixedFit)) return;
  draw_heading(context.style, "Panels");
  for (const Shortcut& shortcut : command::panel.shortcuts())
    draw_row(shortcut.text(), panel_info(shortcut.values.front()).title);
  draw_heading(context.style, "Mouse");
  for (const auto& [gesture, help] : mouse) draw_row(gesture, help);
  ImGui::EndTable();
}

}  // namespace

void draw_shortcut_sheet(const PanelContext& context, const Rectangle& window) {
  if (!context.window.shortcuts_open) return;
  const Style& style = context.style;
  ImGui::SetNextWindowPos({float(window.x + window.width / 2), float(window.y + window.height / 2)}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {float(window.width), float(window.height) - style.px(12)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(20), style.px(16)));
  ImGui::Begin("Keys and mouse", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_HorizontalScrollbar);
  if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
  ImGui::PushFont(style.small);
  constexpr std::array widths = {345.0f, 360.0f, 370.0f};
  const int columns = window.width > style.px(1120)  ? 3
                      : window.width > style.px(750) ? 2
                                                     : 1;  // the rest goes beneath
  if (ImGui::BeginTable("sheet", columns, ImGuiTableFlags_SizingFixedFit)) {
    for (int c = 0; c < columns; ++c)
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, style.px(widths[std::size_t(c)]));
    ImGui::TableNextColumn();
    draw_menus(context, {"File", "Scan", "Timeline", "Gibbs", "Window"});
    ImGui::TableNextColumn();
    draw_menus(context, {"Select", "Scene", "Layers"});
    ImGui::TableNextColumn();
    draw_panels_and_mouse(context);
    ImGui::EndTable();
  }
  ImGui::PopFont();
  ImGui::Spacing();
  if (ImGui::Button("Close")) context.post(command::shortcuts());
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace nextview

#include "ui/panels/shortcut_sheet.hpp"

#include <array>
#include <string>
#include <utility>

namespace nextview {
namespace {

constexpr std::array mouse = {
    std::pair{"Left drag", "turn the scene"},
    std::pair{"Middle drag, Shift + left drag", "move it"},
    std::pair{"Wheel", "nearer, farther"},
    std::pair{"Click a frustum", "look at this view"},
    std::pair{"Click a voxel", "inspect it"},
    std::pair{"Click a ray", "inspect it"},
    std::pair{"Point at a candidate", "see its frustum"},
    std::pair{"Drop a file", "scan this object, or with these settings (.toml)"},
};

void draw_row(std::string_view keys, std::string_view help) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(keys.data(), keys.data() + keys.size());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(help.data(), help.data() + help.size());
}

void draw_keys(const PanelContext& context) {
  if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit, {context.style.px(330), 0})) return;
  for (const Command& command : commands())
    if (const std::string keys = command.keys(); !keys.empty()) draw_row(keys, command.text);
  for (const Shortcut& shortcut : find_command("panel").shortcuts)
    draw_row(shortcut.text(), "Show panel: " + shortcut.arguments.front());
  ImGui::EndTable();
}

void draw_mouse(const PanelContext& context) {
  if (!ImGui::BeginTable("mouse", 2, ImGuiTableFlags_SizingFixedFit, {context.style.px(430), 0})) return;
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
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
  heading(style, "Keys and mouse");
  ImGui::Spacing();
  ImGui::PushFont(style.small);
  if (ImGui::BeginTable("sheet", 2, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableNextColumn();
    draw_keys(context);
    ImGui::TableNextColumn();
    draw_mouse(context);
    ImGui::EndTable();
  }
  ImGui::PopFont();
  ImGui::Spacing();
  if (ImGui::Button("Close")) context.call("shortcuts");
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace nextview

#include "ui/panels/shortcut_sheet.hpp"

#include <array>
#include <string>
#include <utility>

#include "ui/window/shortcuts.hpp"

namespace nextview {
namespace {

constexpr std::array mouse = {
    std::pair{"Left drag", "turn the scene"},
    std::pair{"Middle drag, Shift + left drag", "move it"},
    std::pair{"Wheel", "nearer, farther"},
    std::pair{"Click on a candidate", "select it"},
    std::pair{"Drop a file", "scan this object, or with these settings (.toml)"},
};

void draw_row(std::string_view keys, std::string_view help) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(keys.data(), keys.data() + keys.size());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(help.data(), help.data() + help.size());
}

}  // namespace

void draw_shortcut_sheet(const Style& style, const Rectangle& scene, bool& open) {
  if (!open) return;
  ImGui::SetNextWindowPos({float(scene.x + scene.width / 2), float(scene.y + scene.height / 2)}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(20), style.px(16)));
  ImGui::Begin("Keys and mouse", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
  heading(style, "Keys and mouse");
  ImGui::Spacing();
  if (ImGui::BeginTable("shortcuts", 2, ImGuiTableFlags_SizingFixedFit, {style.px(520), 0})) {
    ImGui::PushFont(style.small);
    for (const Shortcut& shortcut : shortcuts()) draw_row(shortcut.keys, shortcut.help);
    for (const auto& [gesture, help] : mouse) draw_row(gesture, help);
    ImGui::PopFont();
    ImGui::EndTable();
  }
  ImGui::Spacing();
  if (ImGui::Button("Close")) open = false;
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace nextview

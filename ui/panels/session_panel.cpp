#include "ui/panels/session_panel.hpp"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "ui/panels/setting_control.hpp"
#include "ui/window/known_objects.hpp"

namespace nextview {
namespace {

/// The names of the sensors that come with the program.
std::vector<std::string> sensor_presets() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / "sensors", error)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A label at the left, and room for a control up to the panel's right border.
void label(const PanelContext& context, const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine(context.style.px(98));
  ImGui::SetNextItemWidth(-FLT_MIN);
}

}  // namespace

void SessionPanel::load(PanelContext& context) const { context.commands.emplace_back(command::Load{edited_}); }

void SessionPanel::draw_object(PanelContext& context, std::vector<Setting>& settings) {
  Setting& setting = find_setting(settings, "object.file");
  std::string& file = *std::get<std::string*>(setting.value);
  label(context, "Object");
  const float arrow = ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(-arrow - context.style.px(2));
  ImGui::InputTextWithHint("##object.file", context.snapshot.object_name.c_str(), &file);
  const bool typed = ImGui::IsItemDeactivatedAfterEdit();
  tooltip(explanation(setting) + ". Or drop a file on the window.");
  ImGui::SameLine(0, context.style.px(2));
  bool chosen = false;
  if (ImGui::BeginCombo("##known objects", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) {
    for (const char* name : known_objects()) {
      if (!ImGui::Selectable(name, context.snapshot.object_name == name)) continue;
      file = name;
      chosen = true;
    }
    ImGui::EndCombo();
  }
  if (typed || chosen) load(context);
}

void SessionPanel::draw_sensor(PanelContext& context, std::vector<Setting>& settings) {
  const Setting& setting = find_setting(settings, "sensor.preset");
  label(context, "Sensor");
  if (ImGui::BeginCombo("##sensor.preset", edited_.sensor_preset.c_str())) {
    for (const std::string& name : sensor_presets()) {
      if (!ImGui::Selectable(name.c_str(), name == edited_.sensor_preset)) continue;
      Configuration changed = edited_;
      apply_sensor_preset(changed, name);
      edited_ = changed;
      load(context);
    }
    ImGui::EndCombo();
  }
  tooltip(explanation(setting));
}

void SessionPanel::draw(PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Session", rectangle);
  if (session_ != context.snapshot.session) {
    session_ = context.snapshot.session;
    edited_ = context.snapshot.configuration;
  }
  heading(context.style, "Session");
  ImGui::Spacing();
  std::vector<Setting> settings = nextview::settings(edited_);
  ImGui::BeginDisabled(!context.snapshot.loaded());
  draw_object(context, settings);
  for (const auto& [text, key] : {std::pair{"Gain", "planner.gain"}, {"Semantics", "planner.semantics"}}) {
    label(context, text);
    if (setting_control(find_setting(settings, key))) load(context);
  }
  draw_sensor(context, settings);
  for (const auto& [text, key] : {std::pair{"Views", "termination.views"}, {"Seed", "seed"}}) {
    label(context, text);
    if (setting_control(find_setting(settings, key))) load(context);
  }
  ImGui::EndDisabled();
  if (context.snapshot.loaded()) {
    small_text(context.style, "A change starts the scan over.");
  }
}

}  // namespace nextview

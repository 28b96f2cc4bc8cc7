#include "ui/panels/session_panel.hpp"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>

#include "core/config/known_objects.hpp"
#include "core/config/object_lengths.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/layer_commands.hpp"

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

constexpr float field_at = 92;  ///< from the panel's left [px]

/// A label at the left, and room for a control and the way back to the default.
void label(const PanelContext& context, const std::string& text, const std::string& help) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text.c_str());
  tooltip(help);
  ImGui::SameLine(context.style.px(field_at));
  ImGui::SetNextItemWidth(-context.style.px(22));
}

/// A small arrow at the end of the row, if the setting has another value than its default.
void draw_way_back(const PanelContext& context, const Setting& setting, const std::string& default_text) {
  if (setting.text() == default_text) return;
  const Style& style = context.style;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - style.px(16));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  if (ImGui::InvisibleButton(("reset##" + setting.key).c_str(), {style.px(16), height}))
    context.post(command::reset_setting(setting.key));
  draw_icon(Icon::reset, {corner.x + style.px(8), corner.y + height / 2}, style.px(10),
            to_imgui_u32(ImGui::IsItemHovered() ? theme::series[0] : theme::soft_ink));
  tooltip(fmt::format("Back to the default, {}", default_text.empty() ? "nothing" : default_text));
}

constexpr std::array groups = {std::pair{"object", "Object"},
                               std::pair{"recorded", "Recorded data"},
                               std::pair{"registration", "Registration"},
                               std::pair{"sensor", "Sensor"},
                               std::pair{"cloud", "Cloud"},
                               std::pair{"map", "Map"},
                               std::pair{"views", "Candidate views"},
                               std::pair{"planner", "Planner"},
                               std::pair{"gibbs", "Gibbs sampler"},
                               std::pair{"termination", "Termination"},
                               std::pair{"evaluation", "Evaluation"}};

/// Simulated scans lie where they are said to.
bool concerns(std::string_view group, const SessionSnapshot& s) {
  return group != "registration" || s.live || s.is_recording();
}

}  // namespace

void SessionPanel::draw_setting(const PanelContext& context, Setting& setting, const char* name) {
  label(context, name,
        fmt::format("{}: {}\n{}", setting.key, setting_help(setting),
                    keeps_scan(setting.key) ? "A change keeps the scan."
                                            : "A change starts the scan over; undo brings it back."));
  if (setting.key == "object.file") {
    draw_object(context, setting);
  } else if (setting.key == "sensor.preset") {
    draw_sensor(context, setting);
  } else if (const auto wanted = setting_control(setting, typed_)) {
    context.post(command::set(setting.key, *wanted));
  }
  if (context.snapshot.loaded() && setting.key != "object.file")
    draw_way_back(context, setting, default_of(setting.key));
}

/// What a length is by default follows from the object's size.
const std::string& SessionPanel::default_of(const std::string& key) const {
  const auto fitted = edited_.fitted.find(key);
  return fitted == edited_.fitted.end() ? defaults_.at(key) : fitted->second;
}

void SessionPanel::draw_object(const PanelContext& context, Setting& setting) {
  std::string& file = *std::get<std::string*>(setting.value);
  const float arrow = ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(-arrow - context.style.px(2));  // it has no way back: long names have that room
  const std::string& object = context.snapshot.object_name;
  // The path is long, and its end matters: until somebody writes the name alone is shown.
  std::string text = typed_.key == setting.key ? typed_.text : object;
  ImGui::InputTextWithHint("##object.file", "a mesh file, or choose one", &text);
  if (ImGui::IsItemActive()) typed_ = {setting.key, text};
  if (ImGui::IsItemDeactivated()) typed_ = {};
  const bool changed = text != object;
  if (changed) file = text;
  const bool typed = changed && ImGui::IsItemDeactivatedAfterEdit();
  tooltip(setting_help(setting) + ". Or drop a file on the window." +
          (setting.text().empty() ? "" : "\n" + setting.text()));
  ImGui::SameLine(0, context.style.px(2));
  bool chosen = false;
  if (ImGui::BeginCombo("##known objects", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) {
    for (const char* name : known_objects()) {
      if (!ImGui::Selectable(name, context.snapshot.object_name == name)) continue;
      file = name;
      chosen = true;
    }
    ImGui::Separator();
    if (ImGui::Selectable("A file…")) context.invoke(command::open);
    ImGui::EndCombo();
  }
  if ((typed || chosen) && !file.empty()) context.post(command::open(file));
}

void SessionPanel::draw_sensor(const PanelContext& context, const Setting& setting) {
  if (ImGui::BeginCombo("##sensor.preset", edited_.sensor_preset.c_str())) {
    for (const std::string& name : sensor_presets())
      if (ImGui::Selectable(name.c_str(), name == edited_.sensor_preset)) context.post(command::set(setting.key, name));
    ImGui::EndCombo();
  }
  tooltip(setting_help(setting));
}

void SessionPanel::draw_group(const PanelContext& context, const std::string& group) {
  ImGui::PushFont(context.style.small);
  ImGui::PushID(group.c_str());  // some stand above the groups, too
  for (Setting& setting : settings_) {
    if (!setting.key.starts_with(group + ".")) continue;
    const bool shows_unit = setting.unit == "m" && std::holds_alternative<double*>(setting.value);
    const std::string unit = setting.unit.empty() || shows_unit ? "" : " [" + setting.unit + "]";
    const std::string name = setting.label() + unit;
    const float end = ImGui::GetCursorPosX() + ImGui::CalcTextSize(name.c_str()).x;
    const bool narrow = end + context.style.px(4) > context.style.px(field_at);
    if (narrow) {  // the name has a line of its own
      ImGui::TextUnformatted(name.c_str());
      tooltip(setting.key + ": " + setting_help(setting));
    }
    draw_setting(context, setting, narrow ? "" : name.c_str());
    if (setting.key == "map.region") command_button(context, command::edit_region, Icon::none, "Drag it in the scene");
  }
  ImGui::PopID();
  ImGui::PopFont();
}

/// What takes longer than to draw it is made once.
void SessionPanel::take(const SessionSnapshot& snapshot) {
  seen_ = &snapshot;
  edited_ = snapshot.configuration;
  settings_ = settings(edited_);
  if (!defaults_.empty()) return;
  Configuration configuration;
  for (const Setting& setting : settings(configuration)) defaults_[setting.key] = setting.text();
}

void SessionPanel::draw(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Session", rectangle, 0, context.style.px(left_panel_width));
  if (!seen_ || (seen_ != &context.snapshot && !ImGui::IsAnyItemActive())) take(context.snapshot);
  draw_setting(context, find_setting(settings_, "object.file"), "Object");  // also when there is none yet
  if (context.snapshot.mesh) {
    const std::string& unit = context.snapshot.guessed_unit;
    small_text(context.style, size_text(context.snapshot.object_box) + (unit.empty() ? "" : "; unit guessed: " + unit));
    if (!unit.empty()) tooltip("The file does not say its unit; Object › unit sets it.");
  }
  ImGui::BeginDisabled(!context.snapshot.loaded());
  for (const auto& [text, key] : {std::pair{"Gain", "planner.gain"},
                                  {"Semantics", "planner.semantics"},
                                  {"Sensor", "sensor.preset"},
                                  {"Voxel", "map.resolution"},
                                  {"Views", "termination.views"},
                                  {"Seed", "seed"}})
    draw_setting(context, find_setting(settings_, key), text);
  small_text(context.style, "Gain, Semantics, Views keep the scan.");
  ImGui::Spacing();
  ImGui::PushStyleColor(ImGuiCol_Header, to_imgui(theme::paper));
  ImGui::PushStyleColor(ImGuiCol_HeaderHovered, to_imgui(theme::sky));
  ImGui::PushStyleColor(ImGuiCol_HeaderActive, to_imgui(theme::sky));
  // In a window that is a little lower than usual the button beneath them stays in sight.
  const bool is_low = rectangle.height < context.style.px(650);
  const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {spacing.x, is_low ? context.style.px(2) : spacing.y});
  for (const auto& [group, title] : groups)
    if (concerns(group, context.snapshot) && ImGui::CollapsingHeader(title)) draw_group(context, group);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(3);
  ImGui::Spacing();
  command_button(context, command::reset_settings, Icon::reset, "All settings back", false,
                 ImGui::GetContentRegionAvail().x);
  ImGui::EndDisabled();
}

}  // namespace nextview

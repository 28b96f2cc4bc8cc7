#include "ui/panels/setting_control.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "core/planner/policy.hpp"
#include "core/setting/quantity.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {
namespace {

using Wanted = std::optional<std::string>;

/// As the field shows it while nobody writes.
std::string shown_text(const Setting& setting) {
  if (const auto* number = std::get_if<double*>(&setting.value)) {
    if (setting.key == "object.longest_side" && **number == 0.0) return "0 m: its own";
    if (setting.unit == "m") return quantity_text(**number);
    return fmt::format("{:.9g}", **number);
  }
  return setting.text();
}

bool shown_in_millimetres(const Setting& setting) {
  return setting.unit == "m" && std::holds_alternative<double*>(setting.value) && shown_text(setting).ends_with(" mm");
}

/// What was written, in the unit that the field showed if it has none of its own.
std::string with_unit(const Setting& setting, const std::string& text) {
  double number = 0.0;
  if (!std::holds_alternative<double*>(setting.value) || !read_quantity(text, setting.unit, number)) return text;
  const bool has_unit = text.find_first_not_of("0123456789.,+-eE ") != text.npos;
  const bool in_millimetres = shown_in_millimetres(setting) && !has_unit;
  Setting wanted = setting;
  double value = 0.0;
  wanted.value = &value;
  wanted.set(in_millimetres ? text + " mm" : text);
  return wanted.text();
}

/// A control for each type that a setting can have.
struct Control {
  const Setting& setting;
  TypedSetting& typed;
  const char* id;

  Wanted operator()(const bool* value) const {
    bool wanted = *value;
    return ImGui::Checkbox(id, &wanted) ? Wanted(wanted ? "true" : "false") : std::nullopt;
  }
  Wanted operator()(const Setting::Choice& choice) const {
    const std::size_t current = choice.get();
    Wanted wanted;
    if (!ImGui::BeginCombo(id, current < choice.names.size() ? choice.names[current].c_str() : "",
                           ImGuiComboFlags_HeightLarge)) {
      return wanted;
    }
    for (std::size_t i = 0; i < choice.names.size(); ++i) {
      if (ImGui::Selectable(choice.names[i].c_str(), i == current) && i != current) wanted = choice.names[i];
      if (setting.key == "planner.gain") tooltip(policy_entry(choice.names[i]).summary);
      if (i == current) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
    return wanted;
  }
  /// Whole numbers are written, or go by one.
  Wanted operator()(const int* value) const {
    const float side = ImGui::GetFrameHeight(), gap = 2;
    ImGui::SetNextItemWidth(std::max(ImGui::CalcItemWidth() - 2 * (side + gap), side));
    ImGui::BeginGroup();
    Wanted wanted = written();
    for (const auto& [sign, by] : {std::pair{"-", -1}, {"+", 1}}) {
      ImGui::SameLine(0, gap);
      const bool allowed = !setting.bounds || setting.bounds->allow(*value + by);
      ImGui::BeginDisabled(!allowed);
      if (ImGui::Button(fmt::format("{}{}", sign, id).c_str(), {side, side})) wanted = std::to_string(*value + by);
      ImGui::EndDisabled();
    }
    ImGui::EndGroup();
    return wanted;
  }
  /// Everything else is written.
  Wanted operator()(const auto*) const { return written(); }

  Wanted written() const {
    const std::string shown = shown_text(setting);
    std::string text = typed.key == setting.key ? typed.text : shown;
    ImGui::InputText(id, &text);
    if (ImGui::IsItemActive()) typed = {setting.key, text};
    if (!ImGui::IsItemDeactivated()) return std::nullopt;
    typed = {};
    return text == shown ? std::nullopt : Wanted(with_unit(setting, text));
  }
};

}  // namespace

std::string setting_help(const Setting& setting) {
  return setting.explanation() + (setting.bounds ? "; " + setting.bounds->text(setting.unit == "m" ? "m" : "") : "");
}

std::optional<std::string> setting_control(const Setting& setting, TypedSetting& typed) {
  const std::string id = "##" + setting.key;
  const Wanted wanted = std::visit(Control{setting, typed, id.c_str()}, setting.value);
  tooltip(setting_help(setting));
  return wanted;
}

}  // namespace nextview

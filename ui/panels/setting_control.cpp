#include "ui/panels/setting_control.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/panels/panel.hpp"

namespace nextview {
namespace {

/// A control for each type that a setting can have. A number that is typed comes to the nearest that is allowed.
struct Control {
  const char* id;
  const std::optional<Bounds>& bounds;

  bool operator()(bool* value) const { return ImGui::Checkbox(id, value); }
  bool operator()(int* value) const {
    ImGui::InputInt(id, value, 1, 10);
    if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
    if (bounds) *value = static_cast<int>(bounds->nearest(*value));
    return true;
  }
  bool operator()(double* value) const {
    ImGui::InputDouble(id, value, 0, 0, "%.6g");
    if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
    if (bounds) *value = bounds->nearest(*value);
    return true;
  }
  bool operator()(std::uint64_t* value) const {
    ImGui::InputScalar(id, ImGuiDataType_U64, value);
    return ImGui::IsItemDeactivatedAfterEdit();
  }
  bool operator()(std::string* value) const {
    ImGui::InputText(id, value);
    return ImGui::IsItemDeactivatedAfterEdit();
  }
  bool operator()(const Setting::Choice& choice) const {
    const std::size_t current = choice.get();
    bool changed = false;
    if (!ImGui::BeginCombo(id, current < choice.names.size() ? choice.names[current].c_str() : "",
                           ImGuiComboFlags_HeightLarge)) {
      return false;
    }
    for (std::size_t i = 0; i < choice.names.size(); ++i) {
      if (ImGui::Selectable(choice.names[i].c_str(), i == current) && i != current) {
        choice.set(i);
        changed = true;
      }
      if (i == current) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
    return changed;
  }
};

}  // namespace

std::string setting_help(const Setting& setting) {
  return setting.explanation() + (setting.bounds ? "; " + setting.bounds->text() : "");
}

bool setting_control(Setting& setting) {
  const std::string id = "##" + setting.key;
  const bool changed = std::visit(Control{id.c_str(), setting.bounds}, setting.value);
  tooltip(setting_help(setting));
  return changed;
}

}  // namespace nextview

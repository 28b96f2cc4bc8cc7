#pragma once
#include "core/session/configuration.hpp"

namespace nextview {

/// A setting's control, without a label, as wide as the next item's width; its help and unit are the tooltip. Returns
/// whether a person has finished changing the setting.
bool setting_control(Setting& setting);

/// "horizontal field of view [deg]"
std::string explanation(const Setting& setting);

/// @pre there is a setting with this key
Setting& find_setting(std::vector<Setting>& settings, const char* key);

}  // namespace nextview

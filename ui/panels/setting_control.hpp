#pragma once
#include <optional>
#include <string>

#include "core/setting/setting.hpp"

namespace nextview {

/// What is being written into the field of a setting, until it is done.
struct TypedSetting {
  std::string key, text;
};

/// A setting's control, without a label, as wide as the next item's width; its help and unit are the tooltip. Lengths
/// are shown in mm below a metre, and what is written without a unit is in the one that is shown. Returns what the user
/// wants it to be, as Setting::set takes it, once they are done; maybe that is not allowed.
std::optional<std::string> setting_control(const Setting& setting, TypedSetting& typed);

/// "horizontal field of view [deg]; from 1 to 170"
std::string setting_help(const Setting& setting);

}  // namespace nextview

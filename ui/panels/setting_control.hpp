#pragma once
#include "core/setting/setting.hpp"

namespace nextview {

/// A setting's control, without a label, as wide as the next item's width; its help and unit are the tooltip. Returns
/// whether the user has finished changing the setting.
bool setting_control(Setting& setting);

/// "horizontal field of view [deg]; from 1 to 170"
std::string setting_help(const Setting& setting);

}  // namespace nextview

#pragma once
#include <span>
#include <string>

#include "core/setting/setting.hpp"

namespace nextview {

/// Numbers of one section as a configuration file that sets nothing else, each with its help; `remark` becomes a
/// comment above them. They are read back to the last bit.
std::string settings_file(std::span<const Setting> settings, const std::string& remark);

}  // namespace nextview

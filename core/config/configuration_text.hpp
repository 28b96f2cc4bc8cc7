#pragma once
#include <filesystem>
#include <string>

#include "core/config/configuration.hpp"

namespace nextview {

/// What read_configuration would make of this text in that file. @throws as it does
Configuration configuration_of(const std::string& text, const std::filesystem::path& file);

}  // namespace nextview

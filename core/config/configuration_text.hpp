#pragma once
#include <filesystem>
#include <string>

#include "core/config/configuration.hpp"

namespace nextview {

/// What read_configuration would make of this text in that file. @throws as it does
Configuration configuration_of(const std::string& text, const std::filesystem::path& file);

/// Whether a TOML text is that of a study (core/study): it has blocks [[planning]] or [[maps]].
bool is_study(const std::string& toml);

}  // namespace nextview

#pragma once
#include <filesystem>

#include "core/config/configuration.hpp"

namespace nextview {

/// The configuration that scans what a user opens: the settings of a .toml file, or of a picture (.png)
/// that carries them; a recording's folder, scan graph
/// (.graph, .log) or scene (.txt); else an object, by file or name. What followed from the object before follows from
/// this one. @throws std::runtime_error "file:line: reason" for a .toml
Configuration with_input(Configuration configuration, const std::filesystem::path& input);

}  // namespace nextview

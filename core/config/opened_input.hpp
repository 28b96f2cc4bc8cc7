#pragma once
#include <filesystem>
#include <string>

#include "core/config/configuration.hpp"

namespace nextview {

/// The configuration that scans what a user opens: the settings of a .toml file, or of a picture (.png)
/// that carries them; a recording's folder, scan graph
/// (.graph, .log) or scene (.txt); else an object, by file or name. What followed from the object before follows from
/// this one. @throws std::runtime_error "file:line: reason" for a .toml
Configuration with_input(Configuration configuration, const std::filesystem::path& input);

/// The file holds settings, not what is scanned.
bool carries_settings(const std::filesystem::path& file);

/// Whether this is the name of an octree's file.
bool is_map(const std::filesystem::path& file);

/// The same after another object: what was set of that one, its unit, axis upwards and size, holds of no other.
Configuration with_next_input(Configuration configuration, const std::filesystem::path& input);

/// Why nothing is opened that is called so, and what to do; empty if its name says that it may be. Its content is not
/// looked at.
std::string not_an_input(const std::filesystem::path& file);

}  // namespace nextview

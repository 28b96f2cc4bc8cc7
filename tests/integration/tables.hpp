#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nextview {

/// Rows of a CSV, by column.
using Table = std::vector<std::map<std::string, std::string>>;
/// Fails the test if a row has not as many cells as the head, or a cell says nan or inf.
Table read_table(const std::string& csv);

/// What a line `key = …` of a TOML says, without its comment; empty if there is none, or if there are two.
std::string toml_value(const std::string& toml, const std::string& key);

/// Of everything in a folder, sorted.
std::vector<std::string> file_names(const std::filesystem::path& folder);

/// A recorded scene: one scan of a wall of 0.4 x 0.4 m, 0.7 m in front of the camera. `resolution` [m].
std::string wall_scene(double resolution);

}  // namespace nextview

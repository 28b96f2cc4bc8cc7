#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace nextview {

/// A page of the manual with its tables made anew. One stands between the lines `<!-- table: NAME -->` and
/// `<!-- end -->`; NAME is `commands` (the window's), `settings`, or `options` (of the program's subcommands).
/// @throws std::runtime_error naming a table that is not known.
std::string with_tables(const std::string& page, const CLI::App& program);

/// What the settings of a key or of a group of them are, as Markdown; empty if there is none: "map.hit", "sensor".
std::string settings_page(const std::string& key_or_group);

}  // namespace nextview

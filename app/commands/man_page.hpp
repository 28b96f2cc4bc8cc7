#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace nextview {

/// The page that `man nextview` shows, made from the program's declarations: its subcommands, their options, and all
/// settings. Source: man(7).
std::string man_page(const CLI::App& program);

}  // namespace nextview

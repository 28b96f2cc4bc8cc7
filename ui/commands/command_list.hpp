#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/commands/command.hpp"

namespace nextview {

/// All commands, in the order of the menus. The commands themselves are declared menu by menu: file_commands.hpp, …
std::span<const std::reference_wrapper<const Command>> commands();
/// The menus' names, in their order.
std::vector<std::string> menus();
/// @throws std::invalid_argument naming the nearest one.
const Command& find_command(std::string_view name);

/// The manual's table: a row per command.
std::string command_table();

}  // namespace nextview

#pragma once
#include "ui/commands/command.hpp"

namespace nextview {

// The commands of each menu.

std::vector<Command> file_commands();
std::vector<Command> scan_commands();
std::vector<Command> gibbs_commands();
std::vector<Command> selection_commands();
std::vector<Command> scene_commands();
std::vector<Command> window_commands();

// Why a command cannot be done, in words that several share; empty if it can.

std::string needs_session(const CommandState& state);
std::string needs_view(const CommandState& state);  ///< that has been taken
/// Nothing may be running that would change the session beneath it.
std::string needs_rest(const CommandState& state);

/// An argument that takes one of a fixed list.
Argument choice(std::string name, std::string help, std::vector<std::string> names);
/// Which of `names` was chosen.
std::size_t index_of(const std::vector<std::string>& names, const std::string& name);

}  // namespace nextview

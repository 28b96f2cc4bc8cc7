#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ui/commands/command.hpp"

namespace nextview {

/// A line of a script: a command's name and its values, those with spaces in double quotes (in which "" means one).
/// @throws std::invalid_argument in one line: no such command, or as Command::read().
CommandCall parse_call(std::string_view line);
/// The calls of a script: a line each; what follows a # is a comment.
/// @throws std::invalid_argument "line 3: …", or with "FILE:" for `place` "FILE:3: …"
std::vector<CommandCall> parse_script(std::string_view text, std::string_view place = "line ");

/// A value as a script has it.
std::string quoted(const std::string& value);

}  // namespace nextview

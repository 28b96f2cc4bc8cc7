#pragma once
#include <string>

namespace nextview {

/// What a command is called now. Names that version 0.4 had and that have changed are read until version 0.6, with one
/// line on the standard error stream for each; all others are as they are.
std::string current_command_name(const std::string& name);

}  // namespace nextview

#pragma once
#include "ui/commands/command.hpp"

namespace nextview::command {

/// A demo's name or file; none: the tour. It is played in place of the session and of what is shown.
extern const CommandOf<std::optional<std::string>> play_demo;
extern const CommandOf<std::string> record;  ///< where to
extern const CommandOf<> record_stop;

}  // namespace nextview::command

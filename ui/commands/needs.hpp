#pragma once
#include <string>

#include "ui/commands/command.hpp"

namespace nextview {

// Why a command cannot be done, in words that several share; empty if it can.

std::string needs_session(const CommandState& state);
std::string needs_view(const CommandState& state);  ///< that has been taken
/// Nothing may be running that would change the session beneath it.
std::string needs_rest(const CommandState& state);

/// What is in memory alone, for people, with how to keep it; empty if nothing is. `undoable`: the views come back.
std::string what_is_lost(const CommandState& state, bool undoable);

/// Asked before what starts the scan over, which `what` names; nothing if nothing is set aside by it.
CommandQuestion restart_question(const CommandState& state, const std::string& what);

}  // namespace nextview

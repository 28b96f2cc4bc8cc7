#pragma once
#include "ui/commands/command.hpp"

namespace nextview::command {

extern const CommandOf<std::string> connect;  ///< the program that drives a scanner, with its arguments
extern const CommandOf<> disconnect, reconnect;
extern const CommandOf<> allow_move, refuse_move;  ///< of a real robot

}  // namespace nextview::command

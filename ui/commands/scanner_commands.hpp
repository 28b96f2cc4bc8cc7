#pragma once
#include "ui/commands/command.hpp"

namespace nextview::command {

extern const CommandOf<std::string> connect;  ///< the program that drives a scanner, with its arguments
extern const CommandOf<> disconnect, reconnect;
extern const CommandOf<std::string> answer;  ///< to what a job waits for

}  // namespace nextview::command

namespace nextview {

/// An answer to what is asked here: never to a later question that nobody has seen yet.
CommandCall answer_to(const WorkerProgress& asked, const std::string& text);

}  // namespace nextview

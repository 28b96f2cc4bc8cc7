#include "ui/commands/command_target.hpp"

#include <stdexcept>

namespace nextview {

void execute(const CommandCall& call, CommandTarget& target) {
  const Command& command = *call.command;
  const std::string reason = command.why_not_now(target.state());
  if (!reason.empty()) throw std::invalid_argument(command.name + ": " + reason);
  call.run(target);
}

}  // namespace nextview

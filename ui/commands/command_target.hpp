#pragma once
#include "ui/commands/command.hpp"
#include "ui/workbench/session_worker.hpp"

namespace nextview {

/// What a command looks at and acts on.
struct CommandTarget {
  SessionWorker& worker;
  WindowState& window;
  const SessionSnapshot& session;
  const WorkerProgress& progress;

  CommandState state() const { return {session, progress, window}; }
};

/// Does it. @throws std::invalid_argument saying why it cannot be done now.
void execute(const CommandCall& call, CommandTarget& target);

}  // namespace nextview

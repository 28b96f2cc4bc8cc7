#pragma once
#include <string>

#include "tests/unit/workbench/gated_worker.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/script.hpp"

namespace nextview {

/// Commands that ask the worker for something, done by the time that `run` returns.
class WorkerCommands : public GatedWorker {
 protected:
  void run(const std::string& line) {
    const auto snapshot = now();
    const WorkerProgress progress = worker_.progress();
    CommandTarget target{worker_, window_, *snapshot, progress};
    execute(parse_call(line), target);
    wait_until_idle();
  }
  WindowState window_;
};

}  // namespace nextview

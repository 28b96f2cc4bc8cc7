#include "ui/window/asked_call.hpp"

#include <utility>

namespace nextview {

bool AskedCall::asks(const CommandCall& call, const CommandState& state) {
  const Command& command = *call.command;
  if (call.line > 0 || !command.question || !command.available(state)) return false;
  question_ = command.question(state, call.values());
  if (question_.text.empty()) return false;
  call_ = call;
  return true;
}

std::optional<CommandCall> AskedCall::answered(const std::string& answer) {
  auto call = std::exchange(call_, std::nullopt);
  return answer == question_.confirm ? call : std::nullopt;
}

WorkerProgress AskedCall::with_question(WorkerProgress progress) const {
  if (!call_ || !progress.question.empty()) return progress;
  progress.question = question_.text;
  progress.answers = {question_.confirm, "Cancel"};
  progress.effects.clear();
  progress.costs = true;
  return progress;
}

}  // namespace nextview

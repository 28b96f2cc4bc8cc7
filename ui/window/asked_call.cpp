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
  if (answer == question_.confirm) return call;
  return answer == question_.other ? question_.instead : std::nullopt;
}

WorkerProgress AskedCall::with_question(WorkerProgress progress) const {
  if (!call_ || !progress.question.empty()) return progress;
  progress.question = question_.text;
  progress.answers = {question_.confirm, "Cancel"};
  if (!question_.other.empty()) progress.answers.insert(progress.answers.begin() + 1, question_.other);
  progress.effects.clear();
  progress.costs = true;
  return progress;
}

}  // namespace nextview

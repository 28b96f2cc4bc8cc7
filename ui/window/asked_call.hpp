#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ui/commands/command.hpp"

namespace nextview {

/// What a person wants done, while they are asked whether they know what it costs. Scripts are not asked.
class AskedCall {
 public:
  /// Whether it has to wait for the answer.
  bool asks(const CommandCall& call, const CommandState& state);
  /// The call, if the answer is that it is to be done. @pre waiting()
  std::optional<CommandCall> answered(const std::string& answer);
  bool waiting() const { return call_.has_value(); }
  bool waiting_for(const Command& command) const { return call_ && call_->command == &command; }
  /// What runs, and the question if nothing else is asked.
  WorkerProgress with_question(WorkerProgress progress) const;

 private:
  std::optional<CommandCall> call_;
  CommandQuestion question_;
};

}  // namespace nextview

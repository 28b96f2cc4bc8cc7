#pragma once
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "ui/commands/command.hpp"

namespace nextview {

/// A line of a script that was not done.
struct ScriptFailure {
  int line = 0;        ///< of the script, from 1; 0: what was to be there before its first line
  std::string reason;  ///< "export: cannot write …"
};

/// A script that is played: which call comes next, and which failed. What a call sets going may fail long after the
/// call; it is counted as a failure of the last call.
class ScriptPlayer {
 public:
  /// Is given each failure.
  void set_on_failure(std::function<void(const ScriptFailure&)> on_failure) { on_failure_ = std::move(on_failure); }

  void add(std::vector<CommandCall> calls);
  bool done() const { return !playing_; }
  /// Whether there is something to do: nothing runs any more (`at_rest`), or the next call is one that can only be made
  /// while something runs, such as to pause it.
  bool may_go_on(const CommandState& state, bool at_rest) const;
  /// Takes the next call, if there is one left. `session` is the latest snapshot. @pre may_go_on()
  std::vector<CommandCall> go_on(const SessionSnapshot& session);

  /// A call cannot be done; ignored unless it is the one that was taken last.
  void refused(const CommandCall& call, const std::string& reason);
  /// What is left is not done, and nothing has failed.
  void stop();
  /// No more is done: what is under way or left has failed.
  void give_up(const std::string& reason);

 private:
  void fail(const std::string& reason) const;

  std::deque<CommandCall> calls_;
  std::string last_;          ///< the command that was taken last; empty: none
  int line_ = 0;              ///< its
  bool playing_ = false;      ///< something was added, and not all of it is done
  std::size_t failures_ = 0;  ///< of the session's requests that are known
  std::function<void(const ScriptFailure&)> on_failure_;
};

}  // namespace nextview

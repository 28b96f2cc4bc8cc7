#include "ui/commands/script_player.hpp"

#include <fmt/format.h>

#include <iterator>

namespace nextview {

void ScriptPlayer::add(std::vector<CommandCall> calls) {
  playing_ |= !calls.empty();
  std::move(calls.begin(), calls.end(), std::back_inserter(calls_));
}

bool ScriptPlayer::may_go_on(const CommandState& state, bool at_rest) const {
  if (!playing_ || calls_.empty()) return playing_ && at_rest;
  const Command& next = *calls_.front().command;
  const WorkerProgress nothing_runs;
  if (next.available(state) && !next.available({state.session, nothing_runs, state.window})) return true;
  return at_rest;
}

std::vector<CommandCall> ScriptPlayer::go_on(const SessionSnapshot& session) {
  if (session.failures > failures_) fail(last_.empty() ? session.message : last_ + ": " + session.message);
  failures_ = session.failures;
  last_.clear();
  playing_ = !calls_.empty();
  if (calls_.empty()) return {};
  std::vector<CommandCall> next = {std::move(calls_.front())};
  calls_.pop_front();
  last_ = next.front().command->name;
  line_ = next.front().line;
  return next;
}

void ScriptPlayer::refused(const CommandCall& call, const std::string& reason) {
  if (playing_ && call.command->name == last_) fail(reason.starts_with(last_ + ": ") ? reason : last_ + ": " + reason);
}

void ScriptPlayer::stop() {
  calls_.clear();
  last_.clear();
  playing_ = false;
}

void ScriptPlayer::give_up(const std::string& reason) {
  if (!last_.empty() && last_ != "quit") fail(fmt::format("{}: {}", last_, reason));
  if (!calls_.empty()) {
    line_ = calls_.front().line;
    fail(fmt::format("{}: {}", calls_.front().command->name, reason));
  }
  calls_.clear();
  last_.clear();
  playing_ = false;
}

void ScriptPlayer::fail(const std::string& reason) const {
  if (on_failure_) on_failure_({line_, reason});
}

}  // namespace nextview

#include "ui/commands/script_recorder.hpp"

#include <algorithm>

#include "ui/commands/file_commands.hpp"
#include "ui/commands/starting_script.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

/// Whether a call makes the one before it needless: the same command with other numbers, as of a slider.
bool replaces(const CommandCall& call, const CommandCall& before) {
  const Command& command = *call.command;
  if (&command != before.command || command.adds_up || command.arguments().empty()) return false;
  const std::size_t values = call.values().size();
  return values > 0 && values == before.values().size() && command.arguments().front().kind == Argument::Kind::number;
}

}  // namespace

void ScriptRecorder::begin(const Configuration& configuration) {
  script_ = starting_script(configuration);
  requests_.clear();
  last_.reset();
}

void ScriptRecorder::begin_with(const std::filesystem::path& input) {
  script_ = {command::open(std::filesystem::absolute(input).string()).text()};
  requests_.clear();
  last_.reset();
}

void ScriptRecorder::add(const CommandCall& call, std::uint64_t request) {
  if (call.command == &command::palette || call.command == &command::shortcuts || call.command == &command::file_dialog)
    return;
  if (last_ && replaces(call, *last_)) {
    script_.pop_back();
    requests_.pop_back();
  }
  script_.push_back(call.text());
  requests_.push_back(request);
  last_ = call;
}

void ScriptRecorder::forget(std::uint64_t request) {
  const auto found = std::find(requests_.rbegin(), requests_.rend(), request);
  if (request == 0 || found == requests_.rend()) return;
  const auto from_end = found - requests_.rbegin() + 1;
  script_.erase(script_.end() - from_end);
  requests_.erase(requests_.end() - from_end);
  last_.reset();
}

}  // namespace nextview

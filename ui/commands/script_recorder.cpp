#include "ui/commands/script_recorder.hpp"

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
  last_.reset();
}

void ScriptRecorder::begin_with(const std::filesystem::path& input) {
  script_ = {command::open(std::filesystem::absolute(input).string()).text()};
  last_.reset();
}

void ScriptRecorder::add(const CommandCall& call) {
  if (call.command == &command::palette || call.command == &command::shortcuts) return;
  if (last_ && replaces(call, *last_)) script_.pop_back();
  script_.push_back(call.text());
  last_ = call;
}

}  // namespace nextview

#include "ui/commands/script_recorder.hpp"

#include <algorithm>
#include <iterator>

#include "ui/commands/file_commands.hpp"
#include "ui/commands/recording_commands.hpp"
#include "ui/commands/scan_commands.hpp"
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

bool is_left_out(const Command& command) {
  using namespace command;
  const Command* const left_out[] = {&palette,   &shortcuts, &file_dialog, &manual,
                                     &play_demo, &record,    &record_stop, &pause};
  return std::ranges::find(left_out, &command) != std::end(left_out);
}

}  // namespace

void ScriptRecorder::begin(const Configuration& configuration) { begin_with(starting_script(configuration)); }

void ScriptRecorder::begin_with(const std::filesystem::path& input) {
  begin_with(std::vector{command::open(std::filesystem::absolute(input).string()).text()});
}

void ScriptRecorder::begin_with_nothing() { begin_with(std::vector<std::string>()); }

void ScriptRecorder::begin_with(std::vector<std::string> lines) {
  history_.times.assign(lines.size(), history_.now);
  history_.lines = std::move(lines);
  requests_.clear();
  last_.reset();
}

void ScriptRecorder::add(const CommandCall& call, std::uint64_t request, double ago) {
  if (is_left_out(*call.command)) return;
  if (last_ && replaces(call, *last_)) {
    history_.lines.pop_back();
    history_.times.pop_back();
    requests_.pop_back();
  }
  history_.lines.push_back(call.text());
  history_.times.push_back(history_.now - ago);
  requests_.push_back(request);
  last_ = call;
}

void ScriptRecorder::forget(std::uint64_t request) {
  const auto found = std::find(requests_.rbegin(), requests_.rend(), request);
  if (request == 0 || found == requests_.rend()) return;
  const auto from_end = found - requests_.rbegin() + 1;
  history_.lines.erase(history_.lines.end() - from_end);
  history_.times.erase(history_.times.end() - from_end);
  requests_.erase(requests_.end() - from_end);
  last_.reset();
}

}  // namespace nextview

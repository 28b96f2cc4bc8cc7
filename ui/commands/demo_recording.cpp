#include "ui/commands/demo_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/commands/command_list.hpp"

namespace nextview {
namespace {

constexpr double shortest = 0.05, longest_wait = 600;  // that is waited for [s]; the latter is what `wait` takes

/// Lines that wait so long, in hundredths.
std::string waits(double seconds) {
  std::string lines;
  for (double left = std::round(100 * seconds) / 100; left >= shortest; left -= longest_wait)
    lines += fmt::format("wait {:.6g}\n", std::min(left, longest_wait));
  return lines;
}

/// It is not to be done again: a demo writes below the folder of its frames only.
bool writes(const std::string& line) { return find_command(line.substr(0, line.find(' '))).writes; }

/// What is shown for a while, and waiting for it, is over where a recording begins after it.
bool is_passing(const std::string& line) {
  constexpr std::array<std::string_view, 4> passing = {"caption", "highlight", "title", "wait"};
  return std::ranges::find(passing, line.substr(0, line.find(' '))) != passing.end();
}

}  // namespace

std::string recorded_demo(const CommandHistory& history, const DemoRecording& recording) {
  std::string demo = "# Recorded by nextview; `nextview demo FILE` plays it.\n";
  double time = recording.since;
  for (std::size_t i = 0; i < history.lines.size(); ++i) {
    if (history.lines[i] == "quit") continue;  // who plays it may want to look at the end
    if (history.times[i] < recording.since && is_passing(history.lines[i])) continue;
    if (history.times[i] - time >= shortest) {
      demo += waits(history.times[i] - time);
      time = history.times[i];
    }
    demo += (writes(history.lines[i]) ? "# " : "") + history.lines[i] + '\n';
  }
  return demo + waits(history.now - time);
}

}  // namespace nextview

#pragma once
#include <string>
#include <vector>

namespace nextview {

/// The commands so far, as a script has them, and when each was given.
struct CommandHistory {
  std::vector<std::string> lines;
  std::vector<double> times;  ///< of each line: how much of the operator's time had passed [s]
  /// The operator's time that has passed [s]: while nothing is computed, and no script plays.
  double now = 0;
};

/// What is recorded from now on, into a file.
struct DemoRecording {
  std::string file;
  double since = 0;  ///< [s, CommandHistory::now]
};

/// A demo that does the same with the same pauses: what was done before the recording began at once, then line by line
/// with `wait`. What wrote files is a comment.
std::string recorded_demo(const CommandHistory& history, const DemoRecording& recording);

}  // namespace nextview

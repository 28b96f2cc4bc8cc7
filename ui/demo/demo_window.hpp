#pragma once
#include "ui/commands/demo_file.hpp"

namespace nextview {

/// Plays a demo in a window of its own, until that is closed. Returns the exit code: 0, or 2 if a line of it was not
/// done, which is told on the standard error stream and ends it. @throws std::runtime_error as run_window()
int show_demo(const Demo& demo);

/// What a line of a demo may be, as a table.
std::string demo_commands();

}  // namespace nextview

#pragma once
#include <CLI/CLI.hpp>

namespace nextview {

/// `window`, which is apart from app/commands as it alone needs a window.
void add_window_command(CLI::App& program);

}  // namespace nextview

#pragma once
#include "core/session/configuration.hpp"
#include "ui/window/command.hpp"

namespace nextview {

/// Opens the window, with the object loaded and ready to step, and does what the script says; returns the exit code
/// once it is closed.
/// @throws std::runtime_error in one line if there is no display, no OpenGL 3.3 or no font.
int run_window(const Configuration& configuration, const std::vector<CommandCall>& script = {});

}  // namespace nextview

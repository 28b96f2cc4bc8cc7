#pragma once
#include "core/session/configuration.hpp"

namespace nextview {

/// Opens the window, with the object loaded and ready to step; returns the exit code once it is closed.
/// @throws std::runtime_error in one line if there is no display, no OpenGL 3.3 or no font.
int run_window(const Configuration& configuration);

}  // namespace nextview

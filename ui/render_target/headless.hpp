#pragma once

namespace nextview {

/// True if this process draws into memory through OSMesa rather than on a display.
bool drawing_headless();

/// Makes this process draw headless. The system's VTK knows displays only, so the program starts itself again with
/// libnextview_headless_gl.so (core/file/installation.hpp) preloaded; call it first in main.
/// Returns in the new process, where the environment is what it was before, so that child processes do not inherit the
/// preloading. Needs /proc.
/// @throws std::runtime_error if the library is missing or does not load.
void ensure_headless(int argc, char** argv);

}  // namespace nextview

#pragma once
#include "core/config/configuration.hpp"
#include "ui/commands/command.hpp"
#include "ui/workbench/session_request.hpp"

namespace nextview {

/// What the window is to do.
struct Script {
  std::string file;  ///< for messages
  std::vector<CommandCall> calls;
  bool stop_on_error = false;  ///< the first call that fails ends the program
  bool demo = false;           ///< played as one, from nothing: no object is opened, and no session is kept
};

/// What the window begins with, in place of the object that is configured.
struct WindowStart {
  std::optional<request::Connect> scanner = {};
  std::filesystem::path session = {};  ///< folder of a session to go on with
  std::string record = {};             ///< a file that all that is done is recorded into; empty: none
  bool offer = false;                  ///< to go on with what nobody closed, if there is such a session
};

/// Opens the window, with the object loaded, or a live scanner reached, and ready to step, and does what the script
/// says; returns the exit code once it is closed: 0, or 2 if a call of the script was not done, each of which is told
/// on the standard error stream as `FILE:LINE: command: reason`.
/// @throws std::runtime_error in one line if there is no display, no OpenGL 3.3 or no font.
int run_window(const Configuration& configuration, const Script& script = {}, const WindowStart& start = {});

}  // namespace nextview

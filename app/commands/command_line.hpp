#pragma once
#include <vector>

namespace nextview {

/// The arguments as CLI11 takes them.
struct CommandLine {
  std::vector<char*> arguments;  ///< with a subcommand: where none is named, `window`
  /// Whether the subcommand draws into memory: it is settled before anything else, as the program then starts itself
  /// again.
  bool draws_headless = false;
};

/// `nextview FILE --gain …` and a bare `nextview` mean the window.
/// @throws std::runtime_error for a word that is no subcommand, nor a file or an object that comes with the program.
CommandLine command_line(std::vector<char*> arguments);

}  // namespace nextview

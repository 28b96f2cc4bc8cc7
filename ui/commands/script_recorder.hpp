#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/configuration.hpp"
#include "ui/commands/command.hpp"

namespace nextview {

/// Writes down what is done, as a script that does it again. Calls that only differ in their numbers, as of a slider,
/// are one line; what opens and closes palette, dialogs, manual and sheet of keys, what plays and records demos,
/// what pauses (the views that were played are steps), and what failed, is left out.
class ScriptRecorder {
 public:
  /// A line a call goes here. It must live longer.
  explicit ScriptRecorder(CommandHistory& history) : history_(history) {}

  /// Starts over with what leads from the default configuration to this one.
  void begin(const Configuration& configuration);
  /// Starts over with what opens this.
  void begin_with(const std::filesystem::path& input);
  /// Starts over with nothing.
  void begin_with_nothing();
  /// `request`: the number of what the session worker was asked for by it; 0: of nothing. `ago`: how long it took
  /// already [s].
  void add(const CommandCall& call, std::uint64_t request = 0, double ago = 0);
  /// A request failed: what asked for it is left out.
  void forget(std::uint64_t request);

 private:
  void begin_with(std::vector<std::string> lines);

  CommandHistory& history_;
  std::vector<std::uint64_t> requests_;  ///< of the last lines of the script, one each
  std::optional<CommandCall> last_;
};

}  // namespace nextview

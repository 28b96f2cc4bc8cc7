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
/// are one line; what opens and closes palette and sheet of keys, and what failed, is left out.
class ScriptRecorder {
 public:
  /// A line a call goes here. It must live longer.
  explicit ScriptRecorder(std::vector<std::string>& script) : script_(script) {}

  /// Starts over with what leads from the default configuration to this one.
  void begin(const Configuration& configuration);
  /// Starts over with what opens this.
  void begin_with(const std::filesystem::path& input);
  /// `request`: the number of what the session worker was asked for by it; 0: of nothing.
  void add(const CommandCall& call, std::uint64_t request = 0);
  /// A request failed: what asked for it is left out.
  void forget(std::uint64_t request);

 private:
  std::vector<std::string>& script_;
  std::vector<std::uint64_t> requests_;  ///< of the last lines of the script, one each
  std::optional<CommandCall> last_;
};

}  // namespace nextview

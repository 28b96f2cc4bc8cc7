#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/configuration.hpp"
#include "ui/commands/command.hpp"

namespace nextview {

/// Writes down what is done, as a script that does it again. Calls that only differ in their numbers, as of a slider,
/// are one line; what opens and closes palette and sheet of keys is left out.
class ScriptRecorder {
 public:
  /// A line a call goes here. It must live longer.
  explicit ScriptRecorder(std::vector<std::string>& script) : script_(script) {}

  /// Starts over with what leads from the default configuration to this one.
  void begin(const Configuration& configuration);
  /// Starts over with what opens this.
  void begin_with(const std::filesystem::path& input);
  void add(const CommandCall& call);

 private:
  std::vector<std::string>& script_;
  std::optional<CommandCall> last_;
};

}  // namespace nextview

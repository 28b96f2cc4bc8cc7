#pragma once
#include <map>
#include <string>

namespace nextview {

/// Where a setting was given, and what it is called there.
struct SettingSource {
  std::string name;   ///< as the user wrote it: "sensor.width" in a file, "--views (termination.views)"
  std::string place;  ///< "scan.toml:3"; empty if it is not in a file
  std::string text;   ///< its value there

  bool operator==(const SettingSource&) const = default;
};
using SettingSources = std::map<std::string, SettingSource>;  ///< by key

/// A message that names settings by their keys, in the words of the one who gave them: keys as they were written, and
/// file and line. "scan.toml:3: sensor.min_range, 0.2 m, must be at most --sensor.max_range, 0.1 m"
std::string as_given(const std::string& message, const SettingSources& sources);

}  // namespace nextview

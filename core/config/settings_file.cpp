#include "core/config/settings_file.hpp"

#include <fmt/format.h>

#include <sstream>

namespace nextview {

std::string settings_file(std::span<const Setting> settings, const std::string& remark) {
  std::istringstream lines(remark);
  std::string text, section;
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  for (const Setting& s : settings) {
    const auto dot = s.key.find('.');
    if (section.empty()) text += fmt::format("[{}]\n", section = s.key.substr(0, dot));
    text += fmt::format("{} = {}  # {}\n", s.key.substr(dot + 1), s.text(), s.help);
  }
  return text;
}

}  // namespace nextview

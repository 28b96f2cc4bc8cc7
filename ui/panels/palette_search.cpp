#include "ui/panels/palette_search.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "core/config/configuration.hpp"
#include "core/file/lower_case.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/file_commands.hpp"

namespace nextview {
namespace {

/// What commands and settings are called elsewhere.
constexpr std::array<std::pair<std::string_view, std::string_view>, 19> other_words = {{
    {"open", "load import project folder"},
    {"set", "settings preferences options configuration parameters"},
    {"reset-settings", "preferences options configuration defaults"},
    {"export", "save scan session"},
    {"save-picture", "screenshot image export"},
    {"quit", "exit close leave"},
    {"step", "capture acquire scan next"},
    {"play", "run start automatic"},
    {"pause", "stop halt"},
    {"undo", "back revert"},
    {"redo", "again forward"},
    {"reset", "restart new begin"},
    {"frame", "fit centre center home"},
    {"text-size", "font zoom scale preferences"},
    {"dark", "theme colours colors night mode preferences"},
    {"manual", "help documentation docs"},
    {"map.resolution", "voxel size grid"},
    {"sensor.range_noise", "accuracy precision"},
    {"object.longest_side", "part size scale"},
}};

std::string_view other_words_of(const std::string& name) {
  const auto found = std::ranges::find(other_words, name, [](const auto& entry) { return entry.first; });
  return found == other_words.end() ? "" : found->second;
}

/// 0: its text has these words in a row, 1: it is called so, 2: its name begins so, 3: what it is called holds the
/// first word, 4: its help does.
int rank(const std::string& name, const std::string& said, const std::vector<std::string>& wanted) {
  const std::string first = wanted.empty() ? "" : wanted.front();
  if (wanted.size() > 1 && said.find(fmt::format("{}", fmt::join(wanted, " "))) != std::string::npos) return 0;
  const bool begins = name.starts_with(first), holds = (name + said).find(first) != std::string::npos;
  return name == first ? 1 : begins ? 2 : holds ? 3 : 4;
}

}  // namespace

std::string PaletteEntry::written() const {
  return command->name + (setting.empty() ? "" : " " + setting) + (needs_no_value() ? "" : " ");
}

std::vector<PaletteEntry> found_in_palette(std::string_view text) {
  std::istringstream words(lower_case(text));
  std::vector<std::string> wanted;
  for (std::string word; words >> word;) wanted.push_back(word);
  std::vector<std::pair<int, PaletteEntry>> found;
  const auto add = [&](const std::string& name, std::string_view other, const std::string& help, PaletteEntry entry) {
    const std::string said = lower_case(fmt::format(" {} {}", entry.text, other));
    const std::string all = name + said + " " + lower_case(help);
    const bool matches = std::ranges::all_of(wanted, [&](const std::string& w) { return all.find(w) != all.npos; });
    if (matches) found.emplace_back(rank(name, said, wanted), std::move(entry));
  };
  for (const Command& command : commands())
    add(command.name, other_words_of(command.name), command.help, {&command, "", command.text});
  Configuration configuration;
  if (!wanted.empty())
    for (const Setting& s : settings(configuration))
      add(s.key, other_words_of(s.key), s.help, {&command::set, s.key, "Setting: " + s.label(), s.explanation()});
  std::ranges::stable_sort(found, {}, [](const auto& entry) { return entry.first; });
  std::vector<PaletteEntry> result;
  for (auto& [ignored, entry] : found) result.push_back(std::move(entry));
  return result;
}

}  // namespace nextview

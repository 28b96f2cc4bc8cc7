#include "ui/panels/palette_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "core/config/configuration.hpp"
#include "core/file/lower_case.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/file_commands.hpp"

namespace nextview {
namespace {

/// What commands are called elsewhere.
constexpr std::array<std::pair<std::string_view, std::string_view>, 16> other_words = {{
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
}};

std::string_view other_words_of(const Command& command) {
  const auto found = std::ranges::find(other_words, command.name, [](const auto& entry) { return entry.first; });
  return found == other_words.end() ? "" : found->second;
}

/// 0: it is called so, 1: its name begins so, 2: what it is called holds the first word, 3: its help does.
int rank(const std::string& name, const std::string& said, const std::string& first) {
  const bool begins = name.starts_with(first), holds = (name + said).find(first) != std::string::npos;
  return name == first ? 0 : begins ? 1 : holds ? 2 : 3;
}

}  // namespace

std::string PaletteEntry::written() const {
  return command->name + (setting.empty() ? "" : " " + setting) + (needs_no_value() ? "" : " ");
}

std::vector<PaletteEntry> found_in_palette(std::string_view text) {
  std::istringstream words(lower_case(text));
  std::vector<std::string> wanted;
  for (std::string word; words >> word;) wanted.push_back(word);
  const std::string first = wanted.empty() ? "" : wanted.front();
  std::vector<std::pair<int, PaletteEntry>> found;
  const auto add = [&](const std::string& name, std::string_view other, const std::string& help, PaletteEntry entry) {
    const std::string said = lower_case(fmt::format(" {} {}", entry.text, other));
    const std::string all = name + said + " " + lower_case(help);
    const bool matches = std::ranges::all_of(wanted, [&](const std::string& w) { return all.find(w) != all.npos; });
    if (matches) found.emplace_back(rank(name, said, first), std::move(entry));
  };
  for (const Command& command : commands())
    add(command.name, other_words_of(command), command.help, {&command, "", command.text});
  Configuration configuration;
  if (!wanted.empty())
    for (const Setting& s : settings(configuration))
      add(s.key, "", s.help, {&command::set, s.key, "Setting: " + s.label(), s.explanation()});
  std::ranges::stable_sort(found, {}, [](const auto& entry) { return entry.first; });
  std::vector<PaletteEntry> result;
  for (auto& [ignored, entry] : found) result.push_back(std::move(entry));
  return result;
}

}  // namespace nextview

#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ui/commands/command.hpp"

namespace nextview {

/// What a text in the palette may mean: a command, or the setting that `set` is to change.
struct PaletteEntry {
  const Command* command;
  std::string setting = {};  ///< its key; empty: the command itself
  std::string text;          ///< for people: "Export the scan…", "Setting: resolution"
  std::string help = {};     ///< of the setting

  const std::string& name() const { return setting.empty() ? command->name : setting; }
  bool needs_no_value() const { return setting.empty() && command->needs_no_value(); }
  std::string written() const;  ///< to mean it, with a space where values are to come: "set map.resolution "
};

/// The likeliest first: those whose name, text or help hold all words, or that people call so elsewhere. Settings only
/// once there is a word.
std::vector<PaletteEntry> found_in_palette(std::string_view text);

}  // namespace nextview

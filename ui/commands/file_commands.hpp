#pragma once
#include "core/config/configuration.hpp"
#include "ui/commands/command.hpp"

namespace nextview::command {

extern const CommandOf<std::string> open;              ///< a file, or a known object
extern const CommandOf<std::string, std::string> set;  ///< a setting's key, and its value as a file has it
extern const CommandOf<std::string> reset_setting;     ///< its key
extern const CommandOf<> reset_settings, quit;
extern const CommandOf<std::string> export_scan, save_script;  ///< where to

}  // namespace nextview::command

namespace nextview {

/// Whether a change of this setting leaves what was scanned as it is.
bool keeps_scan(std::string_view key);

}  // namespace nextview

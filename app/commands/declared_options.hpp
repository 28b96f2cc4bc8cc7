#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace nextview {

// What subcommands declare, for those who tell people of it: the manual, the man page, the shell.

/// By its key, or by the short name of one.
bool is_setting(const CLI::Option& option);

/// Those of a subcommand that are neither settings nor --help, in the order in which they were declared.
std::vector<const CLI::Option*> own_options(const CLI::App& command);

/// "--out DIR"
std::string usage(const CLI::Option& option);

/// What it does, with the default that it has of itself.
std::string description(const CLI::Option& option);

/// The values that it may have, if these are few and have names: of --gain "new-surface", "occlusion-aware", ….
std::vector<std::string> choices(const CLI::Option& option);

}  // namespace nextview

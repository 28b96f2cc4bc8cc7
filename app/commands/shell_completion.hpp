#pragma once
#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

namespace nextview {

/// What bash completes after `nextview`: subcommands, their options, the values that have names, and of some commands
/// and options the `names` that they take, as `help` its topics; else files. Made from the program's declarations.
/// Source: bash(1), Programmable Completion.
std::string bash_completion(const CLI::App& program, const std::map<std::string, std::vector<std::string>>& names);

}  // namespace nextview

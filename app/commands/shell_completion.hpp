#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace nextview {

/// What bash completes after `nextview`: subcommands, their options, the values that have names, topics of the manual
/// after `help`; else files. Made from the program's declarations. Source: bash(1), Programmable Completion.
std::string bash_completion(const CLI::App& program, const std::vector<std::string>& topics);

}  // namespace nextview

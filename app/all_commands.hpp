#pragma once
#include <CLI/CLI.hpp>

namespace nextview {

/// All of the program's subcommands, in the order of `--help`, each with the function that runs it when the command
/// line is parsed; that ends the parsing with CLI::RuntimeError and the exit code.
void add_commands(CLI::App& program);

}  // namespace nextview

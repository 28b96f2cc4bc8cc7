#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace nextview {

/// A subcommand registers its options with the program and the function that runs it; the function returns the exit
/// code.
void add_scan_command(CLI::App& program);
void add_score_command(CLI::App& program);
void add_refine_command(CLI::App& program);
void add_posterior_command(CLI::App& program);
void add_calibrate_command(CLI::App& program);
void add_info_command(CLI::App& program);
void add_export_command(CLI::App& program);
void add_study_command(CLI::App& program);
void add_figure_command(CLI::App& program);
void add_driver_command(CLI::App& program);
void add_demo_command(CLI::App& program);
void add_help_command(CLI::App& program);

std::vector<std::string> figure_names();  ///< that `figure` draws

/// Exit codes: 0 done, 2 bad input or settings, 130 stopped by the user.
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_stopped = 130;

}  // namespace nextview

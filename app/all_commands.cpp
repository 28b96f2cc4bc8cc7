#include "app/all_commands.hpp"

#include "app/commands/commands.hpp"
#include "app/window_command.hpp"

namespace nextview {

void add_commands(CLI::App& program) {
  program.description("Nextview: where should the scanner look next? Without a subcommand it opens the window.");
  program.set_version_flag("--version", "nextview " NEXTVIEW_VERSION);
  program.require_subcommand(0, 1);
  program.fallthrough();
  program.footer(
      "Examples:\n  nextview bunny.ply\n  nextview scan --out out\n  nextview help\n  nextview SUBCOMMAND --help");
  add_scan_command(program);
  add_score_command(program);
  add_refine_command(program);
  add_posterior_command(program);
  add_calibrate_command(program);
  add_info_command(program);
  add_export_command(program);
  add_study_command(program);
  add_figure_command(program);
  add_driver_command(program);
  add_demo_command(program);
  add_help_command(program);
  add_window_command(program);
}

}  // namespace nextview

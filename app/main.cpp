#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <string_view>
#include <vector>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/scarcity.hpp"
#include "core/file/atomic_file.hpp"
#include "core/session/stopped.hpp"
#include "ui/surface/headless.hpp"
#include "ui/window/window.hpp"

namespace {

constexpr std::uintmax_t longest_script = std::uintmax_t{1} << 20;  // [bytes]

/// Whether this command draws into memory: it is settled before anything else, as the program then starts itself again.
bool draws_headless(const std::vector<std::string_view>& arguments) {
  const auto has = [&](std::string_view word) {
    return std::find(arguments.begin(), arguments.end(), word) != arguments.end();
  };
  return (has("scan") || has("refine") || has("calibrate")) && !has("--no-pictures") && !has("--help") && !has("-h");
}

/// None without a file. @throws std::runtime_error naming the file, the line and the reason.
std::vector<nextview::CommandCall> read_script(const std::string& file) {
  if (file.empty()) return {};
  try {
    return nextview::parse_script(nextview::read_file(file, longest_script));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
  }
}

int run(int argc, char** argv) {
  using namespace nextview;
  CLI::App program("Nextview: where should the scanner look next? Without a subcommand it opens the window.");
  program.set_version_flag("--version", "nextview " NEXTVIEW_VERSION);
  program.require_subcommand(0, 1);
  program.fallthrough();
  program.footer("Examples:\n  nextview bunny.ply\n  nextview scan --out out\n  nextview SUBCOMMAND --help");

  std::unique_ptr<tbb::global_control> limit;
  const auto limit_threads = [&](int threads) {
    if (threads > 0)
      limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
  };
  program.add_option_function<int>("--threads", limit_threads, "threads to use; 0: all. Results never depend on it")
      ->check(CLI::Range(0, 1024));
  ConfigurationOptions options;
  add_scan_command(program);
  add_score_command(program);
  add_refine_command(program);
  add_posterior_command(program);
  add_calibrate_command(program);
  CLI::App* window = program.add_subcommand("window", "Open the window: the same as no subcommand");
  options.add_to(*window);
  std::string script;
  window->add_option("--script", script, "does what this file says: a command a line, as in the palette (Ctrl+P)");
  bool list_commands = false;
  window->add_flag("--list-commands", list_commands, "prints all commands and ends");
  window->footer("Examples:\n  nextview window bunny.ply --gain area-factor\n  nextview bunny.ply");

  try {
    program.parse(argc, argv);
  } catch (const CLI::RuntimeError& end) {  // a subcommand ran
    return end.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    fmt::print(stderr, "nextview: {}; see nextview --help\n", error.what());
    return exit_bad_input;
  }
  if (list_commands) {
    fmt::print("{}", command_table());
    return 0;
  }
  return run_window(options.configuration(), read_script(script));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace nextview;
  try {
    prepare_for_scarcity();
    std::vector<char*> arguments(argv, argv + argc);
    // `nextview FILE --gain …` and a bare `nextview` mean the window.
    static char window[] = "window";
    const std::string_view first = argc > 1 ? argv[1] : "";
    constexpr std::array commands = {"scan",   "score",  "refine", "posterior", "calibrate",
                                     "window", "--help", "-h",     "--version", "--threads"};
    const bool names_command = std::find(commands.begin(), commands.end(), first) != commands.end();
    if (!names_command) arguments.insert(arguments.begin() + 1, window);
    if (draws_headless({arguments.begin() + 1, arguments.end()})) ensure_headless(argc, argv);
    return run(static_cast<int>(arguments.size()), arguments.data());
  } catch (const Stopped&) {
    fmt::print(stderr, "{}nextview: stopped\n", ::isatty(STDERR_FILENO) ? "\r\033[K" : "");  // over the progress line
    return exit_stopped;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "nextview: {}\n", out_of_memory_line());
    return exit_bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "nextview: {}\n", error.what());
    return exit_bad_input;
  }
}

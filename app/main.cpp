#include <fcntl.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/scanner.hpp"
#include "app/commands/scarcity.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/session_folder.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/script.hpp"
#include "ui/panels/panel_table.hpp"
#include "ui/render_target/headless.hpp"
#include "ui/window/window.hpp"

namespace {

constexpr std::uintmax_t longest_script = std::uintmax_t{1} << 20;  // [bytes]

/// None without a file. @throws std::runtime_error naming the file, the line and the reason.
std::vector<nextview::CommandCall> read_script(const std::string& file) {
  if (file.empty()) return {};
  const std::string text = nextview::read_file(file, longest_script);
  try {
    return nextview::parse_script(text);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
  }
}

/// A descriptor that the caller has closed would be given to the next file that is opened, and what is printed would
/// go there. /dev/null, opened the wrong way round, fails as a closed one does.
void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  // What cannot be printed is not to end a run before it has written its files: it shows at the end.
  static std::array<char, 1 << 20> held;
  if (!::isatty(STDOUT_FILENO)) std::setvbuf(stdout, held.data(), _IOFBF, held.size());
}

int fail(std::string_view reason) {
  fmt::print(stderr, "nextview: {}\n", nextview::printable(reason));
  return nextview::exit_bad_input;
}

/// Whether all that was printed has arrived, on a full disk for example, is known only now.
int end(int exit_code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return exit_code;
  // An earlier flush has failed and not said why; the next byte fails likewise.
  if (errno == 0 && ::write(STDOUT_FILENO, "\n", 1) == 1) return fail("standard output: a part of it is lost");
  return fail(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
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
  add_info_command(program);
  add_export_command(program);
  add_study_command(program);
  add_figure_command(program);
  add_driver_command(program);
  add_demo_command(program);
  CLI::App* window = program.add_subcommand("window", "Open the window: the same as no subcommand");
  options.add_to(*window);
  std::string script;
  CLI::Option* script_option =
      window->add_option("--script", script,
                         "does what this file says: a command a line, as in the palette (Ctrl+P); a line that fails is "
                         "reported as FILE:LINE, the others are done, and the exit code is 2");
  ScannerOptions scanner;
  scanner.add_to(*window);
  bool stop_on_error = false;
  window->add_flag("--stop-on-error", stop_on_error, "ends the program at the first line of the script that fails")
      ->needs(script_option);
  bool list_commands = false;
  window->add_flag("--list-commands", list_commands, "prints all commands and ends");
  window->footer("Examples:\n  nextview window bunny.ply --gain area-factor\n  nextview bunny.ply");

  try {
    program.parse(argc, argv);
  } catch (const CLI::RuntimeError& end) {  // a subcommand ran
    return end.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    return fail(fmt::format("{}; see nextview --help", error.what()));
  }
  announce_panels(standard_panels());  // before there is a window: scripts name them
  if (list_commands) {
    fmt::print("{}", command_table());
    return 0;
  }
  WindowStart start;
  if (is_session(options.object())) {
    if (scanner.wanted() || options.gives_settings())
      throw std::invalid_argument(options.object() + ": a session goes on with its own settings; give none beside it");
    start.session = options.object();
    return run_window({}, {script, read_script(script), stop_on_error}, start);
  }
  const Configuration configuration = options.configuration();
  if (scanner.wanted()) start.scanner = {scanner.command, scanner.confirm == "always", configuration};
  start.offer = !scanner.wanted() && script.empty() && options.object().empty() && !options.gives_settings();
  return run_window(configuration, {script, read_script(script), stop_on_error}, start);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace nextview;
  open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond `ulimit -f` is an error as a full disk is
  end_on_interrupt();
  try {
    prepare_for_scarcity();
    CommandLine line = command_line({argv, argv + argc});
    if (line.draws_headless) ensure_headless(argc, argv);
    return end(run(static_cast<int>(line.arguments.size()), line.arguments.data()));
  } catch (const Stopped&) {
    fmt::print(stderr, "{}nextview: stopped\n", ::isatty(STDERR_FILENO) ? "\r\033[K" : "");  // over the progress line
    return exit_stopped;
  } catch (const std::bad_alloc&) {
    return fail(out_of_memory_line());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::system_error& error) {
    return std::ferror(stdout) ? end(exit_bad_input) : fail(error.what());
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

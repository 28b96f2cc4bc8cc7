#include "app/window_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "app/commands/options.hpp"
#include "app/commands/scanner.hpp"
#include "core/file/read_file.hpp"
#include "core/session/recent_files.hpp"
#include "core/session/session_folder.hpp"
#include "core/session/untitled_sessions.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/commands/script.hpp"
#include "ui/window/window.hpp"

namespace nextview {
namespace {

constexpr std::uintmax_t longest_script = std::uintmax_t{1} << 20;  // [bytes]

/// None without a file. @throws std::exception naming the file, the line and the reason.
std::vector<CommandCall> read_script(const std::string& file) {
  if (file.empty()) return {};
  return parse_script(read_file(file, longest_script), file + ":");
}

struct WindowArguments {
  ConfigurationOptions options;
  ScannerOptions scanner;
  std::string script, record;
  bool stop_on_error = false, list_commands = false;
};

int run(const WindowArguments& a) {
  if (a.list_commands) return fmt::print("{}", command_table()), 0;
  const Script script{a.script, read_script(a.script), a.stop_on_error};
  WindowStart start;
  start.record = a.record;
  const std::string object = a.options.object();
  if (is_session(object)) {
    if (a.scanner.wanted() || a.options.gives_settings())
      throw std::invalid_argument(object + ": a session goes on with its own settings; give none beside it");
    start.session = object;
    return run_window({}, script, start);
  }
  const Configuration configuration = a.options.configuration();
  resolve_object(configuration);  // who is wrong about the file need not look for it in the window
  if (a.script.empty() && is_there(object)) add_recent_file(state_folder(), object);
  if (a.scanner.wanted()) start.scanner = {a.scanner.command, a.scanner.confirm == "always", configuration};
  start.offer = !a.scanner.wanted() && a.script.empty() && object.empty() && !a.options.gives_settings();
  return run_window(configuration, script, start);
}

}  // namespace

void add_window_command(CLI::App& program) {
  auto a = std::make_shared<WindowArguments>();
  CLI::App* window = program.add_subcommand("window", "Open the window: the same as no subcommand");
  a->options.add_to(*window);
  CLI::Option* script_option =
      window->add_option("--script", a->script,
                         "does what this file says: a command a line, as in the palette (Ctrl+P); a line that fails is "
                         "reported as FILE:LINE, the others are done, and the exit code is 2");
  a->scanner.add_to(*window);
  window->add_flag("--stop-on-error", a->stop_on_error, "ends the program at the first line of the script that fails")
      ->needs(script_option);
  window->add_option("--record", a->record, "records all that is done in the window as a demo: nextview demo FILE")
      ->type_name("FILE.nextview");
  window->add_flag("--list-commands", a->list_commands, "prints all commands and ends");
  window->footer("Examples:\n  nextview window bunny.ply --gain area-factor\n  nextview bunny.ply");
  window->callback([a] { throw CLI::RuntimeError(run(*a)); });
}

}  // namespace nextview

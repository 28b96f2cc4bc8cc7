#include "app/program.hpp"

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

#include "app/all_commands.hpp"
#include "app/commands/command_line.hpp"
#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/scarcity.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"
#include "core/setting/setting.hpp"
#include "ui/panels/panel_table.hpp"
#include "ui/render_target/headless.hpp"

namespace {

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
  if (errno == EPIPE) return exit_code;  // `| head -3` has read what it wants
  return fail(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

/// The arguments that nothing takes, in the order they were typed in, and what the first mistyped option may be.
std::string too_much(const CLI::App& program) {
  const std::vector<std::string> words = program.remaining(true);
  std::vector<std::string> options = {"--threads", "--version", "--help"};
  for (const CLI::App* command : program.get_subcommands())
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  std::string text = fmt::format("not expected: {}", fmt::join(words, " "));
  const CLI::App& command = program.get_subcommands().empty() ? program : *program.get_subcommands().front();
  std::vector<std::string> under;
  for (const CLI::App* subcommand : command.get_subcommands({})) under.push_back(subcommand->get_name());
  if (!words.empty() && !words.front().starts_with('-'))
    if (const std::string hint = nextview::did_you_mean(words.front(), under); !hint.empty()) return text + hint;
  const auto mistyped =
      std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-') && word.size() > 2; });
  if (mistyped == words.end()) return text;
  std::string name = mistyped->substr(0, mistyped->find('='));
  name.erase(0, name.find_first_not_of('-'));
  return text + nextview::did_you_mean("--" + name, options);
}

/// What CLI11 says, but for what it says of options as "At Most 1 required but received 2", "1 required INT missing",
/// "--out excludes --resume"; and what an argument is that is missing.
std::string reason_of(const CLI::ParseError& error, const CLI::App& command) {
  const std::string text = error.what(), required = " is required";
  if (text.ends_with(required))
    if (const auto* missing = command.get_option_no_throw(text.substr(0, text.size() - required.size())))
      return fmt::format("{}: {}", text, missing->get_description());
  const std::size_t twice = text.find(": At Most 1 required but received "), without = text.find(": 1 required ");
  const std::string excludes = " excludes ";
  if (const std::size_t other = text.find(excludes); other != text.npos)
    return fmt::format("{} and {} do not go together: leave one of them out", text.substr(0, other),
                       text.substr(other + excludes.size()));
  if (twice != text.npos) return text.substr(0, twice) + " is given more than once";
  return without == text.npos ? text : text.substr(0, without) + " is given no value";
}

int run(int argc, char** argv) {
  using namespace nextview;
  CLI::App program;
  add_commands(program);
  std::unique_ptr<tbb::global_control> limit;
  const auto limit_threads = [&](int threads) {
    if (threads > 0)
      limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
  };
  program.add_option_function<int>("--threads", limit_threads, "threads to use; 0: all. Results never depend on it")
      ->check(within(0, 1024));
  announce_panels(standard_panels());  // before there is a window: scripts and demos name them
  try {
    program.parse(argc, argv);
  } catch (const CLI::RuntimeError& end) {  // a subcommand ran
    return end.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    const auto commands = program.get_subcommands();
    const std::string command = commands.empty() ? "" : commands.front()->get_name() + " ";
    const bool is_too_much = error.get_exit_code() == int(CLI::ExitCodes::ExtrasError);
    const std::string reason =
        is_too_much ? too_much(program) : reason_of(error, commands.empty() ? program : *commands.front());
    return fail(fmt::format("{} nextview {}--help", reason + (reason.ends_with('?') ? " See" : "; see"), command));
  }
  return 0;
}

}  // namespace

int nextview::run_program(int argc, char** argv) {
  open_standard_streams();
  std::signal(SIGPIPE, [](int) {});  // a reader that has gone is EPIPE; programs that are started have the default
  std::signal(SIGXFSZ, SIG_IGN);     // a file that grows beyond `ulimit -f` is an error as a full disk is
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
    const bool is_unread = error.code() == std::errc::broken_pipe;
    return std::ferror(stdout) ? end(is_unread ? 0 : exit_bad_input) : fail(error.what());
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

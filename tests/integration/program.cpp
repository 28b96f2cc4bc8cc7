#include "tests/integration/program.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>

#include "core/file/atomic_file.hpp"

namespace nextview {
namespace {

/// Runs it behind `prefix`, commands that run others.
Result run(const std::string& prefix, const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string(), err = (folder.path() / "err").string();
  const std::string command = fmt::format("env -u DISPLAY -u WAYLAND_DISPLAY {} '{}' {} >'{}' 2>'{}'", prefix,
                                          NEXTVIEW_PROGRAM, arguments, out, err);
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(out), read_file(err)};
}

}  // namespace

Result nextview(const std::string& arguments) { return run("", arguments); }

Result nextview_interrupted(double seconds, const std::string& arguments) {
  return run(fmt::format("timeout --preserve-status --signal=INT {} env --default-signal=INT", seconds), arguments);
}

Result nextview_behind(const std::string& commands, const std::string& arguments) { return run(commands, arguments); }

}  // namespace nextview

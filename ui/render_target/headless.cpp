#include "ui/render_target/headless.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/file/installation.hpp"

namespace nextview {
namespace {

constexpr const char* library_name = "libnextview_headless_gl.so";
/// Set for the process that is started again: "PID DESCRIPTOR", its own (exec keeps it) and the library's. What
/// LD_PRELOAD and ASAN_OPTIONS were before is kept in the two others.
constexpr const char* guard = "NEXTVIEW_HEADLESS";
constexpr const char* saved_preload = "NEXTVIEW_SAVED_LD_PRELOAD";
constexpr const char* saved_asan_options = "NEXTVIEW_SAVED_ASAN_OPTIONS";

std::runtime_error cannot_draw(const std::string& reason) {
  return std::runtime_error("cannot draw without a display: " + reason);
}

std::optional<std::string> variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

/// Puts `addition` before what a variable lists, and keeps its old value in `saved`.
void extend_variable(const char* name, const char* saved, const std::string& addition) {
  const auto old = variable(name);
  old ? ::setenv(saved, old->c_str(), 1) : ::unsetenv(saved);
  ::setenv(name, old && !old->empty() ? (addition + ":" + *old).c_str() : addition.c_str(), 1);
}

void restore_variable(const char* name, const char* saved) {
  if (const auto old = variable(saved)) {
    ::setenv(name, old->c_str(), 1);
  } else {
    ::unsetenv(name);
  }
  ::unsetenv(saved);
}

/// The library's descriptor, if this is the process that ensure_headless started again. Who inherits the variables has
/// another process number: to it they mean nothing.
std::optional<int> restarted_with() {
  int process = 0, descriptor = 0;
  const auto text = variable(guard);
  if (!text || std::sscanf(text->c_str(), "%d %d", &process, &descriptor) != 2 || process != ::getpid())
    return std::nullopt;
  return descriptor;
}

std::filesystem::path this_program() {
  std::error_code error;
  const auto program = running_program(error);
  if (error) throw cannot_draw(fmt::format("/proc/self/exe: {}; mount /proc, or give --no-pictures", error.message()));
  return program;
}

}  // namespace

bool drawing_headless() { return ::dlsym(RTLD_DEFAULT, "nextview_headless_gl") != nullptr; }

void ensure_headless(int argc, char** argv) {
  if (const auto descriptor = restarted_with()) {
    ::close(*descriptor);
    ::unsetenv(guard);
    restore_variable("LD_PRELOAD", saved_preload);
    restore_variable("ASAN_OPTIONS", saved_asan_options);
    if (!drawing_headless())
      throw cannot_draw(std::string(library_name) +
                        " did not load; see the loader's message above, and install libosmesa6");
  }
  if (drawing_headless()) return;

  const auto program = this_program();
  const auto library = libraries_of(program) / library_name;
  // The loader splits LD_PRELOAD at blanks and colons, and looks for what remains in the working folder. The path of an
  // open file has neither; the new process inherits the descriptor.
  const int descriptor = ::open(library.c_str(), O_RDONLY);
  if (descriptor < 0 || argc < 1)
    throw cannot_draw(fmt::format("{}: {}; build the target nextview_headless_gl, or install the whole program",
                                  library.string(), std::strerror(errno)));
  ::setenv(guard, fmt::format("{} {}", ::getpid(), descriptor).c_str(), 1);
  extend_variable("LD_PRELOAD", saved_preload, fmt::format("/proc/self/fd/{}", descriptor));
  // A preloaded library comes before the address sanitizer's, which only refuses that by default.
  extend_variable("ASAN_OPTIONS", saved_asan_options, "verify_asan_link_order=0");
  ::execv(program.c_str(), argv);
  throw cannot_draw(fmt::format("starting {} again failed: {}", program.string(), std::strerror(errno)));
}

}  // namespace nextview

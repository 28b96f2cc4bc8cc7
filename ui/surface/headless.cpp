#include "ui/surface/headless.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace nextview {
namespace {

constexpr const char* library_name = "libnextview_headless_gl.so";
/// Set in the process that was started again. It keeps what LD_PRELOAD and ASAN_OPTIONS were before.
constexpr const char* guard = "NEXTVIEW_HEADLESS";
constexpr const char* saved_preload = "NEXTVIEW_SAVED_LD_PRELOAD";
constexpr const char* saved_asan_options = "NEXTVIEW_SAVED_ASAN_OPTIONS";

std::optional<std::string> variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

/// Appends `addition` to a variable that is a list, and keeps its old value in `saved`.
void extend_variable(const char* name, const char* saved, const std::string& addition) {
  const auto old = variable(name);
  if (old) ::setenv(saved, old->c_str(), 1);
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

}  // namespace

bool drawing_headless() { return ::dlsym(RTLD_DEFAULT, "nextview_headless_gl") != nullptr; }

void ensure_headless(int argc, char** argv) {
  if (std::getenv(guard)) {
    ::unsetenv(guard);
    restore_variable("LD_PRELOAD", saved_preload);
    restore_variable("ASAN_OPTIONS", saved_asan_options);
    if (!drawing_headless()) {
      throw std::runtime_error(std::string("cannot draw without a display: ") + library_name +
                               " did not load; see the loader's message above, and install libosmesa6");
    }
  }
  if (drawing_headless()) return;

  const auto executable = std::filesystem::read_symlink("/proc/self/exe");
  const auto library = executable.parent_path() / library_name;
  if (argc < 1 || !std::filesystem::exists(library)) {
    throw std::runtime_error("cannot draw without a display: " + library.string() +
                             " is missing; build the target nextview_headless_gl, or copy it beside the executable");
  }
  ::setenv(guard, "1", 1);
  extend_variable("LD_PRELOAD", saved_preload, library.string());
  // A preloaded library comes before the address sanitizer's, which only refuses that by default.
  extend_variable("ASAN_OPTIONS", saved_asan_options, "verify_asan_link_order=0");
  ::execv(executable.c_str(), argv);
  throw std::runtime_error("cannot draw without a display: starting " + executable.string() +
                           " again failed: " + std::strerror(errno));
}

}  // namespace nextview

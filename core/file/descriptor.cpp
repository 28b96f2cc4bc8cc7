#include "core/file/descriptor.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace nextview {

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

std::runtime_error file_error(const std::filesystem::path& file, const char* verb, int error) {
  const char* const advice = error == ENAMETOOLONG ? "; give a shorter one" : "";
  return std::runtime_error(fmt::format("{}: cannot be {}: {}{}", file.string(), verb, std::strerror(error), advice));
}

}  // namespace nextview

#include "core/file/read_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <vector>

namespace nextview {
namespace {

struct stat status_of(const Descriptor& descriptor, const std::filesystem::path& file) {
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) throw file_error(file, "read", errno);
  return status;
}

}  // namespace

Descriptor open_regular_file(const std::filesystem::path& file) {
  // Without O_NONBLOCK a pipe is waited for until somebody opens its other end.
  Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!descriptor.is_open() && errno != ENXIO) throw file_error(file, "read", errno);  // ENXIO: a socket
  const mode_t mode = descriptor.is_open() ? status_of(descriptor, file).st_mode : S_IFSOCK;
  if (S_ISDIR(mode)) throw file_error(file, "read", EISDIR);
  if (!S_ISREG(mode))
    throw std::runtime_error(
        fmt::format("{}: cannot be read: is a pipe, socket or device; give a regular file", file.string()));
  return descriptor;
}

std::string read_file(const std::filesystem::path& file, std::uintmax_t largest) {
  const Descriptor descriptor = open_regular_file(file);
  const auto size = static_cast<std::uintmax_t>(status_of(descriptor, file).st_size);
  if (size > largest)
    throw std::runtime_error(fmt::format("{}: has {} bytes; at most {} are read", file.string(), size, largest));
  std::string content;
  content.reserve(size);
  std::vector<char> part(1 << 16);  // files under /proc do not tell their size
  for (;;) {
    const ssize_t got = ::read(descriptor.get(), part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw file_error(file, "read", errno);
    if (got == 0) return content;
    content.append(part.data(), static_cast<std::size_t>(got));
    if (content.size() > largest)
      throw std::runtime_error(
          fmt::format("{}: has more than the {} bytes that are read at most", file.string(), largest));
  }
}

bool is_there(const std::filesystem::path& name) {
  std::error_code error;
  return std::filesystem::exists(std::filesystem::symlink_status(name, error));
}

}  // namespace nextview

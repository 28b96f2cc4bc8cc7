#include "core/file/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <string_view>
#include <system_error>

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".nextview-", suffix = ".part";
constexpr std::size_t digits = 32;  // 128 bits

std::string random_name() {
  std::random_device random;
  return fmt::format("{}{:08x}{:08x}{:08x}{:08x}{}", prefix, random(), random(), random(), random(), suffix);
}

bool is_temporary_name(std::string_view name) {
  if (name.size() != prefix.size() + digits + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix))
    return false;
  return name.substr(prefix.size(), digits).find_first_not_of("0123456789abcdef") == name.npos;
}

/// False if someone else holds the lock, or has removed the file: a clean-up that came between making and locking it.
bool is_locked_and_there(const Descriptor& file) {
  struct stat status {};
  // Where a file system knows no locks nobody cleans up, either.
  return (::flock(file.get(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) && ::fstat(file.get(), &status) == 0 &&
         status.st_nlink > 0;
}

}  // namespace

TemporaryFile make_temporary_file(const fs::path& folder, mode_t permissions) {
  for (;;) {
    const fs::path file = folder / random_name();
    Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, permissions));
    if (!descriptor.is_open() && errno == EEXIST) continue;
    if (!descriptor.is_open()) throw std::system_error(errno, std::generic_category());
    if (is_locked_and_there(descriptor)) return {file, std::move(descriptor)};
  }
}

void remove_abandoned_temporary_files(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!is_temporary_name(entry->path().filename().native())) continue;
    const Descriptor file(::open(entry->path().c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (file.is_open() && ::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode) &&
        status.st_uid == ::geteuid() && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0)
      ::unlink(entry->path().c_str());
  }
}

}  // namespace nextview

#include "core/session/captures_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/file/own_folder.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view name_beginning = "nextview-captures-";
constexpr std::time_t long_enough = 60;  ///< for a folder that was just made to be locked [s]

/// Locked as long as this is open. Whoever holds no lock any more is gone, in whatever container it ran.
Descriptor locked(const fs::path& folder) {
  Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  const bool is_locked = descriptor.is_open() && ::flock(descriptor.get(), LOCK_EX | LOCK_NB) == 0;
  return is_locked ? std::move(descriptor) : Descriptor();
}

void remove_abandoned(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!entry->path().filename().native().starts_with(name_beginning)) continue;
    const Descriptor lock = locked(entry->path());
    struct stat status {};
    std::error_code ignored;
    if (lock.is_open() && ::fstat(lock.get(), &status) == 0 && status.st_uid == ::geteuid() &&
        status.st_mtime < std::time(nullptr) - long_enough)
      fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace

CapturesFolder::CapturesFolder(const fs::path& temporary) : owner_(::getpid()) {
  remove_abandoned(temporary);
  path_ = make_own_folder(name_beginning, temporary);
  lock_ = locked(path_);
}

CapturesFolder::~CapturesFolder() {
  std::error_code ignored;
  if (::getpid() == owner_) fs::remove_all(path_, ignored);  // not a child of it
}

}  // namespace nextview

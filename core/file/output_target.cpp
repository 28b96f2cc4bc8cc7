#include "core/file/output_target.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>

#include "core/file/descriptor.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// /dev/stdout and /dev/fd/N lead here. Such a link stands for an open file, also where it reads like a path.
bool in_proc(const fs::path& link) {
  std::error_code error;
  const fs::path folder = fs::canonical(link.has_parent_path() ? link.parent_path() : ".", error);
  return !error && folder.native().starts_with("/proc/");
}

}  // namespace

OutputTarget output_target(const fs::path& file) {
  constexpr int max_links = 40;  // as the kernel has it
  OutputTarget target{file, false, std::nullopt};
  struct stat status {};
  for (int links = 0;; ++links) {
    if (::lstat(target.file.c_str(), &status) != 0) {
      if (errno == ENOENT) return target;
      throw file_error(file, "written", errno);
    }
    if (!S_ISLNK(status.st_mode)) break;
    if (links == max_links) throw file_error(file, "written", ELOOP);
    if (in_proc(target.file)) {
      target.is_stream = true;
      return target;
    }
    target.file = target.file.parent_path() / fs::read_symlink(target.file);
  }
  target.is_stream = S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode);
  if (target.is_stream) return target;
  if (S_ISDIR(status.st_mode)) throw file_error(file, "written", EISDIR);
  if (!S_ISREG(status.st_mode)) throw std::runtime_error(file.string() + ": cannot be written: is a disk or a socket");
  // Renaming over a file asks for its folder's permission only; that a file is read-only means something, too.
  if (::faccessat(AT_FDCWD, target.file.c_str(), W_OK, AT_EACCESS) != 0) throw file_error(file, "written", errno);
  target.standing = {status.st_mode & 0777, status.st_uid, status.st_gid};
  return target;
}

}  // namespace nextview

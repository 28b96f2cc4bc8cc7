#include "core/mesh/file_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace nextview {
namespace {

std::runtime_error failure(const std::filesystem::path& file, std::string_view reason) {
  return std::runtime_error(fmt::format("{}: {}", file.string(), reason));
}

std::string system_reason() { return std::generic_category().message(errno); }

/// Owns the file that is written beside the final one, and removes it unless it was renamed.
class FileBeside {
 public:
  explicit FileBeside(const std::filesystem::path& file)
      : path_(fmt::format("{}.{}.new", file.string(), ::getpid())),
        descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {}
  ~FileBeside() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
  }
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;

  /// False with errno set if any byte did not reach the disk.
  bool write(std::string_view bytes) {
    if (descriptor_ < 0) return false;
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return ::fsync(descriptor_) == 0;
  }
  bool rename_to(const std::filesystem::path& file) {
    renamed_ = ::rename(path_.c_str(), file.c_str()) == 0;
    return renamed_;
  }

 private:
  std::string path_;
  int descriptor_;
  bool renamed_ = false;
};

}  // namespace

std::string read_bytes(const std::filesystem::path& file, std::uintmax_t largest) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw failure(file, "there is no such file");
  if (error) throw failure(file, fmt::format("cannot be read: {}", error.message()));
  if (std::filesystem::is_directory(status)) throw failure(file, "is a directory, not a file");
  if (!std::filesystem::is_regular_file(status)) throw failure(file, "is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw failure(file, fmt::format("cannot be read: {}", error.message()));
  if (size == 0) throw failure(file, "is empty");
  if (size > largest) throw failure(file, fmt::format("has {} bytes, more than the limit of {} bytes", size, largest));

  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw failure(file, fmt::format("cannot be opened: {}", system_reason()));
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (in.gcount() != static_cast<std::streamsize>(size)) throw failure(file, "could not be read to its end");
  return bytes;
}

void write_bytes(const std::filesystem::path& file, std::string_view bytes) {
  FileBeside beside(file);
  if (!beside.write(bytes) || !beside.rename_to(file))
    throw failure(file, fmt::format("cannot be written: {}", system_reason()));
}

}  // namespace nextview

#include "core/file/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <mutex>
#include <set>
#include <system_error>

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What earlier processes left is looked for once in each folder.
void clean_up_once(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> cleaned;
  std::error_code error;
  const fs::path name = fs::canonical(folder, error);
  const std::scoped_lock lock(mutex);
  if (!error && cleaned.insert(name).second) remove_abandoned_temporary_files(name);
}

TemporaryFile open_for_writing(const fs::path& file, const OutputTarget& target) {
  if (target.is_stream) {
    // What is redirected into a file (/dev/stdout) goes on at its end.
    Descriptor stream(::open(target.file.c_str(), O_WRONLY | O_APPEND | O_NOCTTY | O_CLOEXEC));
    if (!stream.is_open()) throw file_error(file, "written", errno);
    return {{}, std::move(stream)};
  }
  const fs::path folder = target.file.has_parent_path() ? target.file.parent_path() : ".";
  clean_up_once(folder);
  try {
    constexpr mode_t nobody_else = 0600, all_that_the_umask_allows = 0666;
    return make_temporary_file(folder, target.standing ? nobody_else : all_that_the_umask_allows);
  } catch (const std::system_error& error) {
    throw file_error(file, "written", error.code().value());
  }
}

/// Returns 0 or an errno.
int reach_the_disk(int descriptor) {
  // Some file systems cannot be asked.
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}

}  // namespace

AtomicFile::AtomicFile(fs::path file)
    : file_(std::move(file)),
      target_(output_target(file_)),
      temporary_(open_for_writing(file_, target_)),
      buffer_(temporary_.descriptor.get()),
      stream_(&buffer_) {}

AtomicFile::~AtomicFile() {
  if (!temporary_.file.empty()) ::unlink(temporary_.file.c_str());
}

void AtomicFile::commit() {
  if (const int error = buffer_.flush()) throw file_error(file_, "written", error);
  if (target_.is_stream) return temporary_.descriptor.close();
  const int descriptor = temporary_.descriptor.get();
  if (const auto& old = target_.standing) {
    [[maybe_unused]] const int given_back = ::fchown(descriptor, old->owner, old->group);  // as far as that is allowed
    if (::fchmod(descriptor, old->permissions) != 0) throw file_error(file_, "written", errno);
  }
  if (const int error = reach_the_disk(descriptor)) throw file_error(file_, "written", error);
  if (::rename(temporary_.file.c_str(), target_.file.c_str()) != 0) throw file_error(file_, "written", errno);
  temporary_.file.clear();
  temporary_.descriptor.close();
}

void write_file(const fs::path& file, std::string_view content) {
  AtomicFile out(file);
  out.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  out.commit();
}

void keep_names(const fs::path& folder) {
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.is_open()) reach_the_disk(opened.get());
}

void require_writable_folder(const fs::path& folder) {
  try {
    clean_up_once(folder);
    const TemporaryFile probe = make_temporary_file(folder, 0600);
    ::unlink(probe.file.c_str());
  } catch (const std::system_error& error) {
    throw file_error(folder, "written to", error.code().value());
  }
}

}  // namespace nextview

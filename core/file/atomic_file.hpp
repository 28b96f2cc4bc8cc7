#pragma once
#include <filesystem>
#include <ostream>
#include <string_view>

#include "core/file/descriptor_buffer.hpp"
#include "core/file/output_target.hpp"
#include "core/file/read_file.hpp"
#include "core/file/temporary_file.hpp"

namespace nextview {

/// A file that appears whole or not at all: written beside its final place under a name of its own, then renamed over
/// it by commit(). Without commit() nothing is left behind; a process that is killed leaves a temporary file that the
/// next one removes. A file that is replaced keeps its permissions and owner. Links are followed, and streams (pipes,
/// devices) written to as it comes; see OutputTarget.
class AtomicFile {
 public:
  /// @throws std::runtime_error naming the file if it or its folder cannot be written to.
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// @throws std::runtime_error naming the file and the reason, e.g. a full disk.
  void commit();

 private:
  std::filesystem::path file_;  ///< as the caller names it
  OutputTarget target_;
  TemporaryFile temporary_;  ///< of a stream: itself, without a name
  DescriptorBuffer buffer_;
  std::ostream stream_;
};

void write_file(const std::filesystem::path& file, std::string_view content);

/// What was made or renamed in a folder is there after a power failure, too, where its file system can promise that; a
/// file alone that reached the disk may be there without its name. It takes a while: it is for what cannot be had
/// again.
void keep_names(const std::filesystem::path& folder);

/// @throws std::runtime_error naming the folder and the reason if no file can be made in it.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace nextview

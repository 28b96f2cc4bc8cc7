#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace nextview {

/// A file that appears whole or not at all: written beside its final place, then renamed over it by commit(). Without
/// commit() nothing is left behind.
class AtomicFile {
 public:
  /// @throws std::runtime_error naming the file if its folder cannot be written to.
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// @throws std::runtime_error naming the file and the reason, e.g. a full disk.
  void commit();

 private:
  std::filesystem::path file_, temporary_;
  std::ofstream stream_;
};

void write_file(const std::filesystem::path& file, std::string_view content);

/// The whole file. @throws std::runtime_error naming the file and the reason: missing, a folder, unreadable, larger
/// than `largest` [bytes].
std::string read_file(const std::filesystem::path& file, std::uintmax_t largest = 1u << 30);

}  // namespace nextview

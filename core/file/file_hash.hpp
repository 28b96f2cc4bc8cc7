#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace nextview {

/// What tells whether a file is still the one it was.
struct FileHash {
  std::uintmax_t bytes = 0;
  std::string crc32;  ///< of all its bytes, as eight hexadecimal digits

  bool operator==(const FileHash&) const = default;
};

/// The same of bytes that come some at a time.
class HashOfParts {
 public:
  void add(std::string_view bytes);
  FileHash hash() const;

 private:
  std::uintmax_t bytes_ = 0;
  std::uint32_t crc_ = 0;  // what zlib begins with
};

/// @throws std::runtime_error naming the file and the reason if it cannot be read.
FileHash file_hash(const std::filesystem::path& file);
/// The same of bytes that are at hand.
FileHash hash_of(std::string_view bytes);

}  // namespace nextview

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

/// @throws std::runtime_error naming the file and the reason if it cannot be read.
FileHash file_hash(const std::filesystem::path& file);
/// The same of bytes that are at hand.
FileHash hash_of(std::string_view bytes);

}  // namespace nextview

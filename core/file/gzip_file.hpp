#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace nextview {

/// What a gzip file holds, decompressed. A few compressed bytes can hold gigabytes: `largest` bounds what comes out.
/// @throws std::runtime_error naming the file and the reason: missing, no regular file, not compressed with gzip,
/// truncated,
///         damaged, holds more than `largest` [bytes].
std::string read_gzip_file(const std::filesystem::path& file, std::uintmax_t largest = 1u << 30);

/// The whole of a file; one whose name ends in .gz is decompressed. @throws as read_file and read_gzip_file
std::string read_plain_or_gzip(const std::filesystem::path& file, std::uintmax_t largest = 1u << 30);

/// The name without a .gz at its end.
std::filesystem::path without_gz(const std::filesystem::path& file);

}  // namespace nextview

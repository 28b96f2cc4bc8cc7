#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace nextview {

/// The whole content of a regular file.
/// @throws std::runtime_error with one line "file: reason": missing, a directory, not a regular file, unreadable,
/// empty, more than `largest` [bytes].
std::string read_bytes(const std::filesystem::path& file, std::uintmax_t largest = 1u << 30);

/// Writes a new file beside `file`, then renames it: at any moment `file` is the old one or the new one, whole.
/// @throws std::runtime_error with one line "file: reason", for example a full disk; the old file then stays as it was.
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

}  // namespace nextview

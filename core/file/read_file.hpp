#pragma once
#include <filesystem>
#include <string>

#include "core/file/descriptor.hpp"

namespace nextview {

/// Opens a regular file to be read. Pipes and devices are refused: they may block, and need not end.
/// @throws std::runtime_error naming the file and the reason: missing, links in a circle, a folder, unreadable.
Descriptor open_regular_file(const std::filesystem::path& file);

/// The whole file. @throws std::runtime_error as open_regular_file, and if it is larger than `largest` [bytes].
std::string read_file(const std::filesystem::path& file, std::uintmax_t largest = 1u << 30);

/// Whether something has this name: a file, a folder, a link that leads nowhere. Never throws.
bool is_there(const std::filesystem::path& name);

}  // namespace nextview

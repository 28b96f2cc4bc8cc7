#pragma once
#include <filesystem>

#include "core/file/file_hash.hpp"

namespace nextview {

/// @throws std::runtime_error naming both if a file is not what it was when `folder` was scanned of it
void require_unchanged(const std::filesystem::path& file, const FileHash& was, const std::filesystem::path& folder);

}  // namespace nextview

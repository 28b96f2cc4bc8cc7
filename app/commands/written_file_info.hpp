#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace nextview {

/// What a table (.csv) or a report (.json) of Nextview's holds, for people; none if Nextview does not write such.
/// @throws std::runtime_error naming the file if it cannot be read
std::optional<std::string> written_file_info(const std::filesystem::path& file);

}  // namespace nextview

#pragma once
#include <filesystem>

namespace nextview {

/// That what is in a folder can be looked at; what is no folder is told by who wants one.
/// @throws std::runtime_error naming the folder, and what to do
void require_readable(const std::filesystem::path& folder);

}  // namespace nextview

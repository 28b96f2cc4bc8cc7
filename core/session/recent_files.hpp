#pragma once
#include <filesystem>
#include <vector>

namespace nextview {

/// What was opened last, in files and folders that are still there, the newest first. `state`: state_folder().
std::vector<std::filesystem::path> recent_files(const std::filesystem::path& state);
/// Puts one first. Never throws: what cannot be kept is not.
void add_recent_file(const std::filesystem::path& state, const std::filesystem::path& file);

}  // namespace nextview

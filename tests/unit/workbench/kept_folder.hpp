#pragma once
#include <filesystem>

namespace nextview {

/// The session that is kept below a state folder, beside the list of recent files; empty if none is.
inline std::filesystem::path kept_folder(const std::filesystem::path& state) {
  for (const auto& entry : std::filesystem::directory_iterator(state))
    if (entry.is_directory()) return entry.path();
  return {};
}

}  // namespace nextview

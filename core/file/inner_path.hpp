#pragma once
#include <algorithm>
#include <filesystem>

namespace nextview {

/// Data of others must not lead out of their folder: in what way a path that they name does, to be read behind it; null
/// if it does not.
inline const char* why_not_within(const std::filesystem::path& path) {
  if (path.is_absolute()) return "must be relative to the folder";
  if (std::ranges::find(path, std::filesystem::path("..")) != path.end()) return "must not lead out of the folder";
  return nullptr;
}

}  // namespace nextview

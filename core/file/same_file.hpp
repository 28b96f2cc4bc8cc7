#pragma once
#include <filesystem>

namespace nextview {

/// By device and inode: links and other spellings are the same. False if one is not there.
inline bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  return std::filesystem::equivalent(a, b, error) && !error;
}

}  // namespace nextview

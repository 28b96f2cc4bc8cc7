#pragma once
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>

namespace nextview {

/// For what is looked for in any case; of ASCII letters.
inline std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

/// What a file's name says of its type, with the dot.
inline std::string lower_case_extension(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace nextview

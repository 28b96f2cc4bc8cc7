#pragma once
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace nextview {

/// For what is looked for in any case; of ASCII letters.
inline std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

}  // namespace nextview

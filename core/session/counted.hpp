#pragma once
#include <string>
#include <string_view>

namespace nextview {

/// For people: "1 view", "2 views".
inline std::string counted(std::size_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

}  // namespace nextview

#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace nextview {

/// For people: "1 vertex", "2 vertices".
inline std::string counted(std::uint64_t count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

/// "1 view", "2 views".
inline std::string counted(std::uint64_t count, std::string_view one) {
  return counted(count, one, std::string(one) + "s");
}

}  // namespace nextview

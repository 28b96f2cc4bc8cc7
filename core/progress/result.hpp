#pragma once
#include <string>
#include <variant>

namespace nextview {

/// Why the world did not do what it was asked. What is expected of robots and sensors is returned; what is wrong with a
/// program or a file is thrown.
struct Failure {
  enum Kind { cancelled, unreachable, no_data, disconnected, refused } kind;
  std::string reason;  ///< one line for people
};

template <class T>
using Result = std::variant<T, Failure>;

}  // namespace nextview

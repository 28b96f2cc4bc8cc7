#pragma once
#include <string>
#include <variant>

namespace nextview {

/// Why the world did not do what it was asked. What is expected of robots and sensors is returned; what is wrong with a
/// program or a file is thrown.
struct Failure {
  /// no_data: nothing came, or nothing was seen; unusable: what came cannot be read, or is not what was asked for.
  enum Kind { cancelled, unreachable, no_data, unusable, disconnected, refused } kind;
  std::string reason;  ///< one line for people
};

template <class T>
using Result = std::variant<T, Failure>;

}  // namespace nextview

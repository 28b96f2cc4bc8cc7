#pragma once

namespace nextview {

/// Functions as one, for std::visit.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // C++20 implies it, and Clang 14 does not know that

}  // namespace nextview

#pragma once
#include <functional>
#include <string>

namespace nextview {

/// What the user copies and pastes.
struct Clipboard {
  std::function<std::string()> get;
  std::function<void(const std::string&)> set;
};

}  // namespace nextview

#pragma once
#include <stdexcept>

namespace nextview {

/// A requested stop came before there was a result.
struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("stopped") {}
};

}  // namespace nextview

#pragma once
#include <stdexcept>
#include <stop_token>

namespace nextview {

/// A requested stop came before there was a result. Who throws it leaves everything as it was.
struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("stopped") {}
};

/// @throws Stopped
inline void throw_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

}  // namespace nextview

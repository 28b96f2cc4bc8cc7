#pragma once
#include <fmt/format.h>

#include <string>

namespace nextview {

/// The entropy of a map [bits] as people read it everywhere: "0.308 Mbit".
inline std::string entropy_text(double bits) { return fmt::format("{:.3f} Mbit", bits / 1e6); }

}  // namespace nextview

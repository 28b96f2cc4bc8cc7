#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nextview {

/// Optical depth, -log of the share of a ray that passes, in fixed point: exact whatever the order in which voxels add
/// to it, so nothing drifts.
namespace optical_depth {
inline constexpr int unit = 4096;
/// Nothing passes, as no float is left of exp(-128): what an occupied voxel adds in `beam`. No voxel adds more, so that
/// `most_voxels` on a ray add up without overflow.
inline constexpr std::int32_t opaque = 1 << 19;
inline constexpr std::int32_t most_voxels = std::numeric_limits<std::int32_t>::max() / opaque;

/// exp(-depth / unit) of the lower, middle and upper bits of a depth: their product is what passes. A chain asks for it
/// more often than for anything else.
struct Tables {
  static constexpr std::uint32_t size = 128;
  std::array<float, size> lower, middle, upper;
};
inline const Tables& tables() {
  static const Tables made = [] {
    Tables t;
    for (std::uint32_t i = 0; i < Tables::size; ++i) {
      const auto factor = [&](double of) { return static_cast<float>(std::exp(-of * i / unit)); };
      t.lower[i] = factor(1.0);
      t.middle[i] = factor(Tables::size);
      t.upper[i] = factor(double(Tables::size) * Tables::size);
    }
    return t;
  }();
  return made;
}

/// The share that passes. @pre 0 <= depth
inline float passing(std::int32_t depth) {
  if (depth >= opaque) return 0.0f;
  const Tables& t = tables();
  const auto at = static_cast<std::uint32_t>(depth);
  const std::uint32_t above = at / (Tables::size * Tables::size);
  return t.lower[at % Tables::size] * t.middle[at / Tables::size % Tables::size] *
         t.upper[std::min(above, Tables::size - 1)];
}
}  // namespace optical_depth

}  // namespace nextview

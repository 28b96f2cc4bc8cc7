#pragma once
#include <algorithm>
#include <limits>

#include "core/map/voxel_grid.hpp"

namespace nextview::slab_test {

/// The part of a ray inside a box, [m] along the ray; empty if `enter` >= `leave`.
struct Overlap {
  double enter, leave;
  double length() const { return leave - enter; }
};

/// Cuts [begin, end] of a ray with the three slabs of a box. Of a ray parallel to a slab, points on its upper face are
/// outside.
inline Overlap overlap(const Vector3& lower, const Vector3& upper, const Vector3& origin, const Vector3& direction,
                       double begin, double end) {
  Overlap o{begin, end};
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (origin[k] < lower[k] || origin[k] >= upper[k]) return {0.0, -1.0};
      continue;
    }
    const double a = (lower[k] - origin[k]) / direction[k], b = (upper[k] - origin[k]) / direction[k];
    o.enter = std::max(o.enter, std::min(a, b));
    o.leave = std::min(o.leave, std::max(a, b));
  }
  return o;
}

inline Overlap overlap(const VoxelGrid& grid, std::uint32_t voxel, double margin, const Vector3& origin,
                       const Vector3& direction, double max_range) {
  const Vector3 half = Vector3::Constant(0.5 * grid.resolution + margin), centre = grid.centre(voxel);
  return overlap(centre - half, centre + half, origin, direction, 0.0, max_range);
}

}  // namespace nextview::slab_test

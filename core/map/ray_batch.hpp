#pragma once
#include <atomic>
#include <cstdint>
#include <span>

#include "core/map/grid_margin.hpp"
#include "core/map/traversal.hpp"

namespace nextview {

/// Rays of one camera, and where they leave their marks.
struct RayBatch {
  const VoxelGrid& grid;
  const Eigen::Vector3f& origin;
  std::span<const Eigen::Vector3f> ends;
  double max_range;
  std::uint8_t* marks;  ///< of the grid with its margin
};

/// Threads may mark the same voxel: they all write the same.
inline void leave_mark(std::uint8_t& mark) { std::atomic_ref(mark).store(1, std::memory_order_relaxed); }

/// Calls `visit(place)` for the voxels of one ray: what the lanes do, as it is meant to be read.
template <class Visit>
void walk_one(const RayBatch& batch, const Eigen::Vector3f& end, Visit visit) {
  const bool short_enough = ray_length(batch.origin, end) <= batch.max_range;
  walk_segment_inside(batch.grid, batch.origin, short_enough ? end : point_on_ray(batch.origin, end, batch.max_range),
                      [&](int x, int y, int z) { return visit(place_with_margin(batch.grid, x, y, z)); });
}
inline void mark_one(const RayBatch& batch, const Eigen::Vector3f& end) {
  walk_one(batch, end, [&](std::size_t place) {
    leave_mark(batch.marks[place]);
    return true;
  });
}

}  // namespace nextview

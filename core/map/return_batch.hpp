#pragma once
#include <atomic>
#include <cstdint>
#include <span>

#include "core/map/voxel_grid.hpp"

namespace nextview {

/// Returns of one camera, and where the numbers of the voxels behind them go.
struct ReturnBatch {
  const VoxelGrid& grid;
  const Eigen::Vector3f& origin;
  std::span<const Eigen::Vector3f> returns;
  double max_range, distance;
  std::uint16_t* numbers;  ///< of the grid with its margin
};

/// The smallest of several numbers stays; 0 is none. Threads may number the same voxel.
inline void leave_number(std::uint16_t& place, std::uint16_t number) {
  const std::atomic_ref<std::uint16_t> nearest(place);
  std::uint16_t seen = nearest.load(std::memory_order_relaxed);
  while (static_cast<std::uint16_t>(seen - 1) >= number &&
         !nearest.compare_exchange_weak(seen, number, std::memory_order_relaxed)) {
  }
}

}  // namespace nextview

#pragma once
#include <cstdint>
#include <span>
#include <stop_token>

#include "core/cloud/point_cloud.hpp"
#include "core/map/grid_margin.hpp"
#include "core/map/zeroed_array.hpp"

namespace nextview {

/// The part of a grid, in whole bricks of it (VoxelBricks), that holds all ways of `distance` [m] on behind returns in
/// it; of no voxels if there is no such return.
VoxelGrid region_behind(const VoxelGrid& grid, const Scan& scan, double distance);

/// How many voxels behind the nearest return each voxel of a grid lies, on the way of a ray that goes on beyond it:
/// many rays at once, in the lanes of the processor's vector registers. The voxels are those of walk_segment from the
/// return on, to the last rounding, on any instruction set and any number of threads.
class OcclusionMarks {
 public:
  /// @throws std::bad_alloc
  explicit OcclusionMarks(const VoxelGrid& grid);

  /// Behind each return [m, world] that lies in the grid and no farther from `origin` than `max_range` [m]: the voxels
  /// up to `distance` [m], without its own, which would be no. 0, and the last one. @throws Stopped
  void mark(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> returns, double max_range, double distance,
            const std::stop_token& stop = {});
  /// The numbers of the voxels from this one on, along x, up to the grid's edge; 0: behind no return.
  const std::uint16_t* row(const Eigen::Vector3i& cell) const {
    return &numbers_[place_with_margin(grid_, cell.x(), cell.y(), cell.z())];
  }

 private:
  VoxelGrid grid_;
  /// Around the grid lies a margin of one voxel, where rays may leave numbers too: so they need not ask where they are.
  ZeroedArray<std::uint16_t> numbers_;
};

}  // namespace nextview

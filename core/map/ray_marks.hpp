#pragma once
#include <cstdint>
#include <span>
#include <stop_token>

#include "core/map/grid_margin.hpp"
#include "core/map/zeroed_array.hpp"

namespace nextview {

/// A byte for each voxel of a grid, 0 at first, in which rays leave a 1 where they pass: many rays at once, in the
/// lanes of the processor's vector registers. The voxels are those of walk_segment_inside, its twin of one ray at a
/// time, to the last rounding, on any instruction set and any number of threads.
class RayMarks {
 public:
  /// @throws std::bad_alloc
  explicit RayMarks(const VoxelGrid& grid);

  /// Rays from `origin` to each of the ends [m, world]; those longer than `max_range` [m] pass as far as that.
  /// Overwrites what mark_ends() has left. @throws Stopped
  void pass(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends, double max_range,
            const std::stop_token& stop = {});
  /// Gives the voxels of the grid in which such rays end this mark; those longer than `max_range` [m] end nowhere.
  void mark_ends(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends, double max_range,
                 std::uint8_t mark);
  /// Of a voxel of the grid.
  std::uint8_t at(const Eigen::Vector3i& cell) const { return marks_[place(cell)]; }
  /// The marks of the voxels from this one on, along x, up to the grid's edge.
  const std::uint8_t* row(const Eigen::Vector3i& cell) const { return &marks_[place(cell)]; }

 private:
  /// Around the grid lies a margin of one voxel, where rays may leave marks too: so they need not ask where they are.
  std::size_t place(const Eigen::Vector3i& cell) const {
    return place_with_margin(grid_, cell.x(), cell.y(), cell.z());
  }

  VoxelGrid grid_;
  ZeroedArray<std::uint8_t> marks_;
};

}  // namespace nextview

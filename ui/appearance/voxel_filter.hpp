#pragma once
#include <optional>

#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// A slab of the world across one axis.
struct Slice {
  int axis = 2;                  ///< 0 x, 1 y, 2 z
  double low = 0.0, high = 0.0;  ///< [m, world]; voxels whose centre is within are in it

  bool holds(double centre) const { return centre >= low && centre <= high; }
  bool operator==(const Slice&) const = default;
};

/// Which voxels are drawn. Unmeasured voxels never are: they are what is not there yet.
struct VoxelFilter {
  bool occupied = true;
  bool unknown = true;  ///< measured, but neither free nor occupied yet
  bool free = false;
  /// Unknown voxels below this probability stay hidden: they are space that a ray or two passed, and would hide the
  /// rest.
  double unknown_from = 0.5;
  bool uncertain = false;        ///< instead of the classes: whatever has at least this entropy
  double entropy_from = 0.5;     ///< [nats], 0 to ln 2
  std::optional<Slice> slice{};  ///< only what is in it

  /// Apart from the slice.
  bool shows(const Voxel& voxel) const {
    if (!voxel.measured) return false;
    if (uncertain) return voxel.entropy >= entropy_from;
    return (occupied && voxel.voxel_class == VoxelClass::occupied) ||
           (unknown && voxel.voxel_class == VoxelClass::unknown && voxel.probability >= unknown_from) ||
           (free && voxel.voxel_class == VoxelClass::free);
  }
  bool shows(const VoxelGrid& grid, std::uint32_t index, const Voxel& voxel) const {
    return shows(voxel) && (!slice || slice->holds(grid.centre(index)[slice->axis]));
  }
  bool shows_nothing() const { return !(occupied || unknown || free || uncertain); }
  bool operator==(const VoxelFilter&) const = default;
};

}  // namespace nextview

#pragma once
#include <optional>

#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "ui/appearance/section.hpp"

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
  bool uncertain = false;            ///< instead of the classes: whatever has at least this entropy
  double entropy_from = 0.5;         ///< [nats], 0 to ln 2
  std::optional<Slice> slice{};      ///< only what is in it
  std::optional<Section> section{};  ///< only what it leaves, by the voxels' centres

  /// Whether the cells there, along an axis, are neither outside of the slice nor cut off.
  bool holds(int axis, double centre) const {
    return (!slice || slice->axis != axis || slice->holds(centre)) &&
           (!section || section->axis != axis || section->holds(centre));
  }
  /// Apart from slice and section.
  bool shows(const Voxel& voxel) const {
    if (!voxel.measured) return false;
    if (uncertain) return voxel.entropy >= entropy_from;
    return (occupied && voxel.voxel_class == VoxelClass::occupied) ||
           (unknown && voxel.voxel_class == VoxelClass::unknown && voxel.probability >= unknown_from) ||
           (free && voxel.voxel_class == VoxelClass::free);
  }
  bool shows(const VoxelGrid& grid, std::uint32_t index, const Voxel& voxel) const {
    if (!shows(voxel)) return false;
    if (!slice && !section) return true;
    const Eigen::Vector3d centre = grid.centre(index);
    return holds(0, centre.x()) && holds(1, centre.y()) && holds(2, centre.z());
  }
  bool shows_nothing() const { return !(occupied || unknown || free || uncertain); }
  bool operator==(const VoxelFilter&) const = default;
};

}  // namespace nextview

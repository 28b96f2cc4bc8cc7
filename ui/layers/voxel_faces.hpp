#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// Which voxels are drawn. Unmeasured voxels never are: they are what is not there yet.
struct VoxelFilter {
  bool occupied = true;
  bool unknown = true;  ///< measured, but neither free nor occupied yet
  bool free = false;
  /// Unknown voxels below this probability stay hidden: they are space that a ray or two passed, and would hide the
  /// rest.
  double unknown_from = 0.5;

  bool shows(const Voxel& voxel) const {
    return voxel.measured &&
           ((occupied && voxel.voxel_class == VoxelClass::occupied) ||
            (unknown && voxel.voxel_class == VoxelClass::unknown && voxel.probability >= unknown_from) ||
            (free && voxel.voxel_class == VoxelClass::free));
  }
};

struct VoxelFace {
  std::uint32_t voxel;
  std::uint8_t side;  ///< 2 * axis, plus 1 on the axis' positive side

  bool operator==(const VoxelFace&) const = default;
};

/// The faces of shown voxels towards voxels that are not shown or beyond the grid, by voxel, then side. Faces between
/// two shown voxels can never be seen and would be most of the work.
std::vector<VoxelFace> exposed_faces(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter);

/// The face's corners, counter-clockwise seen from outside [m, world].
std::array<Vector3, 4> face_corners(const VoxelGrid& grid, const VoxelFace& face);

/// Outward, of length 1.
Vector3 face_normal(const VoxelFace& face);

}  // namespace nextview

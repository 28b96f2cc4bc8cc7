#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ui/appearance/voxel_filter.hpp"

namespace nextview {

struct VoxelFace {
  std::uint32_t voxel;
  std::uint8_t side;  ///< 2 * axis, plus 1 on the axis' positive side
  /// How much shown voxels before the face keep light from each of its corners, in the order of face_corners: two bits
  /// a corner, from 0 (open) to 3 (in a nook).
  std::uint8_t occlusion = 0;

  int occlusion_at(int corner) const { return occlusion >> (2 * corner) & 3; }
  bool operator==(const VoxelFace&) const = default;
};

/// The faces of shown voxels towards voxels that are not shown or beyond the grid, by voxel, then side. Faces between
/// two shown voxels can never be seen and would be most of the work. On all cores; the same on any number of them.
/// @throws std::invalid_argument if the number of voxels is not the grid's, or the slice's axis is none.
std::vector<VoxelFace> exposed_faces(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter);

/// The face's corners, counter-clockwise seen from outside [m, world].
std::array<Vector3, 4> face_corners(const VoxelGrid& grid, const VoxelFace& face);

/// Outward, of length 1.
Vector3 face_normal(const VoxelFace& face);

/// The first shown voxel that a ray meets, also if it starts in it. `direction` of any length but 0.
/// @throws std::invalid_argument if the number of voxels is not the grid's, or there is no direction.
std::optional<std::uint32_t> voxel_on_ray(const Vector3& origin, const Vector3& direction, const VoxelGrid& grid,
                                          std::span<const Voxel> voxels, const VoxelFilter& filter);

}  // namespace nextview

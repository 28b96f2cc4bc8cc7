#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// From here on a voxel is occupied, and a point inside.
inline constexpr float solid_from = 0.5f;

/// Of each voxel of a map how solid it is, from 0 to 1: its probability; 1 where nothing was measured. Cleaned of what
/// no surface of the object can be, see map_surface.
/// @pre one voxel a voxel of the grid
std::vector<float> solid_voxels(const VoxelGrid& grid, std::span<const Voxel> voxels);

/// What a voxel is part of.
enum class Wall : std::uint8_t {
  none,   ///< nothing solid
  thick,  ///< among eight solid voxels around a corner: a block
  thin,   ///< in no block: a wall one voxel thin
  step,   ///< beside a thin voxel, in a block whose voxels are in no other: where a thin wall steps to the next layer
  speck   ///< in no block, one of fewer than four on something thick: where that barely touches the next voxel
};
std::vector<Wall> wall_voxels(const VoxelGrid& grid, std::span<const float> solid);

}  // namespace nextview

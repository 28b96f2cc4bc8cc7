#pragma once
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

/// Solid voxels that are part of a wall one voxel thin: among no eight solid voxels around a corner. Specks of fewer
/// than four such voxels on something thicker are none: they are where it barely touches the next voxel. 1: thin.
std::vector<std::uint8_t> thin_voxels(const VoxelGrid& grid, std::span<const float> solid);

}  // namespace nextview

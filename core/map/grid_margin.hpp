#pragma once
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// Where a voxel of a grid stands in an array that has a margin of one voxel around the grid: rays in lanes learn there
/// that they have left it, or leave there what nobody asks for.
inline std::size_t place_with_margin(const VoxelGrid& grid, int x, int y, int z) {
  return (std::size_t(z + 1) * (grid.size.y() + 2) + (y + 1)) * (grid.size.x() + 2) + (x + 1);
}
inline std::size_t places_with_margin(const VoxelGrid& grid) {
  return (std::size_t(grid.size.x()) + 2) * (grid.size.y() + 2) * (grid.size.z() + 2);
}

}  // namespace nextview

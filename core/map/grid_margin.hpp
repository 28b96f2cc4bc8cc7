#pragma once
#include <cstdint>
#include <span>

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

/// Gives such an array's margin a value, and what there is behind it. The voxels' places stay as they are.
void fill_margin(const VoxelGrid& grid, std::span<std::uint8_t> array, std::uint8_t value);
void fill_margin(const VoxelGrid& grid, std::span<std::uint16_t> array, std::uint16_t value);
void fill_margin(const VoxelGrid& grid, std::span<float> array, float value);

}  // namespace nextview

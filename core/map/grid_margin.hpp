#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/map/voxel_grid.hpp"

namespace nextview {

/// Where a voxel of a grid stands in an array that has a margin of one voxel around the grid: rays in lanes learn there
/// that they have left it, or leave there what nobody asks for.
inline std::size_t place_with_margin(const VoxelGrid& grid, int x, int y, int z) {
  return (std::size_t(z + 1) * (grid.size.y() + 2) + (y + 1)) * (grid.size.x() + 2) + (x + 1);
}
/// The voxel of a place that is not in the margin.
inline Eigen::Vector3i cell_of_place(const VoxelGrid& grid, std::uint32_t place) {
  const auto row = std::uint32_t(grid.size.x()) + 2, rows = std::uint32_t(grid.size.y()) + 2;
  return Eigen::Vector3i(int(place % row), int(place / row % rows), int(place / row / rows)) - Eigen::Vector3i::Ones();
}
inline std::size_t places_with_margin(const VoxelGrid& grid) {
  return (std::size_t(grid.size.x()) + 2) * (grid.size.y() + 2) * (grid.size.z() + 2);
}

/// Gives the layers of such an array's margin below and above the voxels a value, and what there is behind it. Who
/// fills the array row by row gives the rest of the margin its value along with it (fill_margin_of_row), while it is in
/// the cache.
template <class Array, class Value>
void fill_margin_layers(const VoxelGrid& grid, Array& array, Value value) {
  const auto layer = std::ptrdiff_t((grid.size.x() + 2) * (grid.size.y() + 2));
  std::fill_n(array.begin(), layer, value);
  std::fill(array.begin() + std::ptrdiff_t(places_with_margin(grid)) - layer, array.end(), value);
}

/// What is beside the row of voxels at y and z: its ends, and of the first and last row of a layer the margin's row.
template <class Array, class Value>
void fill_margin_of_row(const VoxelGrid& grid, int y, int z, Array& array, Value value) {
  const auto length = std::ptrdiff_t(grid.size.x()) + 2;
  const auto row = array.begin() + std::ptrdiff_t(place_with_margin(grid, -1, y, z));
  row[0] = row[length - 1] = value;
  if (y == 0) std::fill_n(row - length, length, value);
  if (y == grid.size.y() - 1) std::fill_n(row + length, length, value);
}

}  // namespace nextview

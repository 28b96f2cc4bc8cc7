#pragma once
#include <algorithm>
#include <array>
#include <optional>

#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// The bounds of the occupied voxels along x, y, z and the six diagonals between two of them.
struct OccupiedHull {
  static constexpr int directions = 9;
  std::array<int, directions> lowest{}, highest{};

  /// How far beyond its nearer side across a direction something lies, so far along it; negative between them.
  int beyond(int direction, int along) const {
    return std::max(along - highest[std::size_t(direction)], lowest[std::size_t(direction)] - along);
  }
  /// How far outside of it a cell lies [voxels]; negative inside.
  double outside(const Eigen::Vector3i& cell) const;
};

/// None if no voxel is occupied. Up to a thousandth of them along any direction may be outliers, which it leaves out.
std::optional<OccupiedHull> occupied_hull(const VoxelBricks& voxels, double occupancy_threshold);

}  // namespace nextview

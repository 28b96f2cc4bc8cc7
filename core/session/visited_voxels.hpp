#pragma once
#include <cstdint>
#include <span>

#include "core/cloud/point_cloud.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// Sets `visited` to 1 for the voxels that the rays of a noise-free scan visit, their ends included.
void mark_visited(const VoxelGrid& grid, const Scan& ideal, std::span<std::uint8_t> visited);

}  // namespace nextview

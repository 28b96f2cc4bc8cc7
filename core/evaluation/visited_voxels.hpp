#pragma once
#include <cstdint>
#include <span>
#include <stop_token>

#include "core/cloud/point_cloud.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// Sets `visited` to 1 for the voxels that the rays of a noise-free scan visit, their ends included.
/// @throws Stopped; then some are marked.
void mark_visited(const VoxelGrid& grid, const Scan& ideal, std::span<std::uint8_t> visited,
                  const std::stop_token& stop = {});

}  // namespace nextview

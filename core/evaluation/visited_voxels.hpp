#pragma once
#include <stop_token>

#include "core/cloud/point_cloud.hpp"
#include "core/map/bit_mask.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// Sets in `visited`, one per voxel, those that the rays of a noise-free scan visit, their ends included.
/// @throws Stopped; then none is set.
void mark_visited(const VoxelGrid& grid, const Scan& ideal, BitMask& visited, const std::stop_token& stop = {});

}  // namespace nextview

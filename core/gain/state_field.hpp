#pragma once
#include <optional>

#include "core/gain/gain.hpp"
#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// What the voxels are worth to a gain, where that is a function of the voxel. None otherwise.
std::optional<StateField> state_field(const VoxelGrid& grid, const VoxelBricks& voxels, double occupancy_threshold,
                                      const Gain& gain, double occlusion_reach);

}  // namespace nextview

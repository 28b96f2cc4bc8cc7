#pragma once
#include <optional>

#include "core/gain/gain.hpp"
#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// What the voxels are worth to a gain, where that is a function of the voxel and the voxels are in few states, as
/// those of an occupancy map whose updates do not depend on the range. None otherwise.
std::optional<StateField> state_field(const VoxelGrid& grid, const VoxelBricks& voxels, double occupancy_threshold,
                                      const Gain& gain, double occlusion_reach);

}  // namespace nextview

#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// A voxel: what the maps and the truth say of it, its measurement history, what the Gibbs sampler thinks of it.
void draw_voxel_details(const PanelContext& context, const VoxelInspection& voxel);

}  // namespace nextview

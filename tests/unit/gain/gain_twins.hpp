#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/gain/ray.hpp"

namespace nextview::gain_twins {

using VoxelsOfRay = std::vector<RayVoxel>;

/// Every gain of one view, written down from the table of gains as it stands there: by name, over the voxels that its
/// rays visit. Nothing is shared with the code under test but the voxels.
std::map<std::string, double> values(std::span<const VoxelsOfRay> rays, Semantics semantics, double d_max);

}  // namespace nextview::gain_twins

#pragma once
#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// Entropy of the maximum-likelihood map (Eq. 18) [bits]: a measured voxel is decided, an unmeasured one is worth one
/// bit.
double unmeasured_entropy(const VoxelBricks& voxels);

/// The full entropy, the sum of H(p) over the voxels [bits].
double total_entropy(const VoxelBricks& voxels);

/// Realised gain (Eq. 12) [nats]: the entropy that the voxels lost from `before` to `after`; negative if they became
/// less certain. Takes the longer, the more bricks have changed. @throws std::invalid_argument if sizes differ.
double realised_gain(const VoxelBricks& before, const VoxelBricks& after);

}  // namespace nextview

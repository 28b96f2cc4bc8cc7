#pragma once
#include "core/map/voxel_bricks.hpp"

namespace nextview {

/// How uncertain a map is [bits].
struct MapEntropy {
  double unmeasured = 0.0;  ///< of the maximum-likelihood map (Eq. 18): an unmeasured voxel is worth a bit, others none
  double total = 0.0;       ///< the sum of H(p) over the voxels
};
MapEntropy map_entropy(const VoxelBricks& voxels);

/// What a map learned from `before` to `after`. Takes the longer, the more bricks have changed.
struct MapChange {
  std::size_t newly_measured = 0;  ///< voxels
  double realised_gain = 0.0;      ///< the entropy that they lost (Eq. 12) [nats]; negative: they became less certain
};
/// @throws std::invalid_argument if sizes differ.
MapChange map_change(const VoxelBricks& before, const VoxelBricks& after);

/// How many voxels are of another class in the one map than in the other. @throws std::invalid_argument if sizes
/// differ.
std::size_t differing_classes(const VoxelBricks& one, const VoxelBricks& other);

}  // namespace nextview

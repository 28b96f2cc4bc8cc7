#pragma once
#include <cstdint>
#include <span>

#include "core/map/occupancy.hpp"

namespace nextview {

/// Entropy of the maximum-likelihood map (Eq. 18) [bits]: a measured voxel is decided, an unmeasured one is worth one
/// bit.
double unmeasured_entropy(std::span<const Voxel> voxels);

/// The full entropy, the sum of H(p) over the voxels [bits].
double total_entropy(std::span<const Voxel> voxels);

/// Realised gain (Eq. 12) [nats]: the entropy that the voxels lost from `before` to `after`; negative if they became
/// less certain. With a mask only the voxels where it is not 0 count, such as those in the frustum.
/// @throws std::invalid_argument if lengths differ.
double realised_gain(std::span<const Voxel> before, std::span<const Voxel> after,
                     std::span<const std::uint8_t> mask = {});

}  // namespace nextview

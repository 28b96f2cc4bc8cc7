#pragma once
#include <span>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// The ends [m] of rays from `origin`, those of a tile of directions (0.04 rad wide) one after the other, each tile's
/// in the order they had: rays that go through the same voxels find these in the processor's cache.
PointCloud in_tiles(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends);

}  // namespace nextview

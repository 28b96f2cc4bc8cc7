#pragma once
#include <cstddef>
#include <span>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// The ends [m] of rays from `origin`, those of a tile of directions (0.04 rad wide) one after the other, each tile's
/// in the order they had: rays that go through the same voxels find these in the processor's cache.
/// It takes a few nanoseconds a ray, and pays where what the rays mark takes more than that cache has room for [bytes].
PointCloud in_tiles(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends);

inline constexpr std::size_t tiles_pay_from = std::size_t{1} << 24;

}  // namespace nextview

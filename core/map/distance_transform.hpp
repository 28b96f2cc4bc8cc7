#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace nextview {

/// Of no feature voxel in the whole grid.
inline constexpr std::int32_t infinitely_far = 1 << 28;

/// The squared distance from each voxel's centre to the nearest feature's [voxels^2], exactly (Meijster et al. 2000).
/// `is_feature`: one a voxel, x fastest. The same on any number of threads.
/// @throws std::invalid_argument if it is not as long as `size` says.
std::vector<std::int32_t> squared_distances(std::span<const std::uint8_t> is_feature, const Eigen::Vector3i& size);

/// How many of the 26 neighbours of each voxel are features; beyond the grid there are none.
/// @throws std::invalid_argument as above.
std::vector<std::uint8_t> neighbour_counts(std::span<const std::uint8_t> is_feature, const Eigen::Vector3i& size);

}  // namespace nextview

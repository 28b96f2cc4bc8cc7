#pragma once
#include <cstdint>
#include <vector>

#include "core/map/bit_rows.hpp"

namespace nextview {

/// Where there is nothing to be far from.
inline constexpr std::int32_t infinitely_far = 1 << 28;

/// The squared distance from the centre of each voxel of `from` to that of the nearest of `to` [voxels^2], exactly
/// (Saito and Toriwaki 1994), in their order, x fastest. The same on any number of threads.
/// @throws std::invalid_argument if they are not of the same size.
std::vector<std::int32_t> squared_distances(const BitRows& from, const BitRows& to);

}  // namespace nextview

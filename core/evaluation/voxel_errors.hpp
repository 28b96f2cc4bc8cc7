#pragma once
#include <span>
#include <vector>

#include "core/evaluation/truth_convention.hpp"

namespace nextview {

/// How far off a map is, voxel by voxel: |p - truth|, from 0 to 1. Not a number for hidden voxels, and, with a mask
/// `counted`, for those where it is 0 (the unmeasured ones, or those that no noise-free ray visits).
/// `probabilities`: one per voxel of the truth's grid; `counted` too, or empty.
/// @throws std::invalid_argument if lengths differ.
std::vector<float> voxel_errors(std::span<const float> probabilities, const GroundTruth& truth,
                                TruthConvention convention, std::span<const std::uint8_t> counted = {});

}  // namespace nextview

#include "core/evaluation/voxel_errors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nextview {

std::vector<float> voxel_errors(std::span<const float> probabilities, const GroundTruth& truth,
                                TruthConvention convention, std::span<const std::uint8_t> counted) {
  const std::size_t voxels = truth.grid.voxel_count();
  if (probabilities.size() != voxels || (!counted.empty() && counted.size() != voxels))
    throw std::invalid_argument(fmt::format("voxel errors: {} probabilities and a mask of {} for {} voxels of truth",
                                            probabilities.size(), counted.size(), voxels));
  std::vector<float> errors(voxels, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t v = 0; v < voxels; ++v) {
    const VoxelTruth is = voxel_truth(truth, v, convention);
    if (is == VoxelTruth::hidden || (!counted.empty() && !counted[v])) continue;
    errors[v] = std::abs(probabilities[v] - (is == VoxelTruth::occupied ? 1.0f : 0.0f));
  }
  return errors;
}

}  // namespace nextview

#pragma once
#include <string_view>

#include "core/map/ground_truth.hpp"

namespace nextview {

/// What makes a voxel occupied in truth; named with every score.
enum class TruthConvention {
  touch,  ///< the surface intersects it
  centre  ///< its centre is inside the closed object
};

constexpr std::string_view name(TruthConvention convention) {
  return convention == TruthConvention::touch ? "touch" : "centre";
}

enum class VoxelTruth : std::uint8_t {
  free,
  occupied,
  hidden  ///< inside and not touched by the surface: no sensor can observe it, no score counts it
};

inline VoxelTruth voxel_truth(const GroundTruth& truth, std::size_t voxel, TruthConvention convention) {
  if (truth.hidden(voxel)) return VoxelTruth::hidden;
  const BitMask& occupied = convention == TruthConvention::touch ? truth.touch : truth.centre;
  return occupied[voxel] ? VoxelTruth::occupied : VoxelTruth::free;
}

}  // namespace nextview

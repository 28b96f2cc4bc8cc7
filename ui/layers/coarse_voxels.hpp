#pragma once
#include <vector>

#include "ui/layers/voxel_faces.hpp"

namespace nextview {

/// Exposed faces as seen from far away.
struct CoarseVoxels {
  VoxelGrid grid;                      ///< whose voxels are larger, on the same lattice
  std::vector<VoxelFace> faces;        ///< of that grid
  std::vector<std::size_t> stand_for;  ///< of each, the place of the first of the faces that it is there for
};

/// With voxels of 2^`halvings` times the edge: each that has an exposed face, with its faces to the sides where it has
/// one, but not towards another such voxel. What is closed stays closed.
CoarseVoxels coarse_voxels(const VoxelGrid& grid, std::span<const VoxelFace> faces, int halvings);

}  // namespace nextview

#pragma once
#include <stop_token>

#include "core/map/bit_mask.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

inline constexpr int band_width = 3;  ///< how far from the surface a voxel is near it [voxels]

/// What the mesh says of each voxel, a bit each.
struct GroundTruth {
  VoxelGrid grid;
  /// The surface intersects the voxel. Voxels are closed: a surface that lies on the face between two voxels touches
  /// both, also when the rounding of its float vertices puts it beside the face (voxels are taken larger by 1e-5 of an
  /// edge on all sides).
  BitMask touch;
  /// The voxel's centre is inside the closed object (even-odd rule, so normals do not matter). A centre on the
  /// surface is on one side or the other, the same for the same mesh. Of a mesh with holes: the vote of the three axes,
  /// see ground_truth.
  BitMask centre;
  BitMask near_surface;  ///< surface_distance is `band_width` at most

  /// Distance to the nearest voxel of the grid that the surface touches, in voxels (Chebyshev), up to 255 (farther, or
  /// there is none). Looks at all of those.
  int surface_distance(std::size_t voxel) const;

  /// Inside and not touched: cannot be observed, and is left out of every score.
  bool hidden(std::size_t voxel) const { return centre[voxel] && !touch[voxel]; }
};

/// The mesh may reach beyond the grid. The inside is found along columns of voxel centres in x, y and z: of a closed
/// mesh all three agree; of a mesh with holes a column that enters and does not leave says 'outside', and two of the
/// three decide.
/// @throws Stopped
GroundTruth ground_truth(const TriangleMesh& mesh, const VoxelGrid& grid, const std::stop_token& stop = {});

}  // namespace nextview

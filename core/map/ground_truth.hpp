#pragma once
#include <stop_token>
#include <vector>

#include "core/map/voxel_grid.hpp"
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// What the mesh says of each voxel.
struct GroundTruth {
  VoxelGrid grid;
  /// 1: the surface intersects the voxel. Voxels are closed: a surface that lies on the face between two voxels touches
  /// both, also when the rounding of its float vertices puts it beside the face (voxels are taken larger by 1e-5 of an
  /// edge on all sides).
  std::vector<std::uint8_t> touch;
  /// 1: the voxel's centre is inside the closed object (even-odd rule, so normals do not matter). A centre on the
  /// surface is on one side or the other, the same for the same mesh. Of a mesh with holes: the vote of the three axes,
  /// see ground_truth.
  std::vector<std::uint8_t> centre;
  /// Distance to the nearest voxel of the grid that the surface touches, in voxels (Chebyshev), up to 255 (farther, or
  /// there is none).
  std::vector<std::uint8_t> surface_distance;

  /// Inside and not touched: cannot be observed, and is left out of every score.
  bool hidden(std::size_t voxel) const { return centre[voxel] && !touch[voxel]; }
};

/// The mesh may reach beyond the grid. The inside is found along columns of voxel centres in x, y and z: of a closed
/// mesh all three agree; of a mesh with holes a column that enters and does not leave says 'outside', and two of the
/// three decide.
/// @throws Stopped
GroundTruth ground_truth(const TriangleMesh& mesh, const VoxelGrid& grid, const std::stop_token& stop = {});

}  // namespace nextview

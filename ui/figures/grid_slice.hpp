#pragma once
#include <span>
#include <vector>

#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/parts.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "ui/charts/page.hpp"

namespace nextview {

/// A layer of a grid's voxels, one voxel thick, and the part of it that is looked at. Of the two axes in the layer the
/// earlier in x, y, z points right, the later up.
struct GridSlice {
  int axis = 1;   ///< at right angles to the layer: 0 x, 1 y, 2 z
  int index = 0;  ///< of the layer, from the grid's lowest [voxels]
  /// What is looked at, from the grid's lowest voxel to the right and up [voxels].
  int left = 0, bottom = 0, width = 0, height = 0;

  int right_axis() const { return axis == 0 ? 1 : 0; }
  int up_axis() const { return axis == 2 ? 1 : 2; }
  /// The voxel in column `right` and row `up` of what is looked at.
  std::uint32_t voxel(const VoxelGrid& grid, int right, int up) const;
  /// Where the middle of the layer lies along `axis` [m, world].
  double position(const VoxelGrid& grid) const;

  /// @throws std::invalid_argument if it is empty or not within the grid.
  void check(const VoxelGrid& grid) const;
};

/// All of a layer.
GridSlice whole_layer(const VoxelGrid& grid, int axis, int index);

/// Cuts across the opening, at right angles to the grid's axis that is nearest to its length, through its centre: its
/// mouths and both walls show.
GridSlice slice_across(const Opening& opening, const VoxelGrid& grid);

/// The layer in which two maps of the grid differ most where either calls a voxel occupied (sum of |difference|; of all
/// voxels if neither does), cropped to what is called occupied. Of equals the first, x before y before z.
GridSlice slice_of_largest_difference(const VoxelGrid& grid, std::span<const Voxel> one, std::span<const Voxel> other);

/// Where the mesh meets the middle of the layer, in pieces [voxels, right and up from the grid's lower corner].
std::vector<LinePiece> cross_section(const TriangleMesh& mesh, const VoxelGrid& grid, const GridSlice& slice);

}  // namespace nextview

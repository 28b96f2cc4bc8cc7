#pragma once
#include <optional>
#include <span>

#include "core/map/voxel_bricks.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/surface/surface.hpp"

namespace nextview {

/// The surface of an occupancy map, conventional or Gibbs, by marching cubes at p = 0.5. A voxel counts as occupied if
/// the surface touches it, so a point is inside only if all voxels around it are occupied: the surface runs through the
/// middle of the outermost occupied voxels. If they are the right ones it lies within half an edge of the true surface
/// (at edges and corners askew to the grid somewhat more); where probabilities lie between 0 and 1 it moves with them.
///
/// Voxels that are not measured count as solid: what no view has seen is closed, and its vertices are not `seen`. Walls
/// one voxel thin become a shell a quarter of a voxel thick. Left out: what lies farther beyond the box of the occupied
/// voxels than a quarter of its longest side; solid pieces with fewer than four occupied voxels side by side (stray
/// hits), but for the largest; free pockets that do not reach the region's border (no camera sees into them; the
/// largest piece of free space always stays).
///
/// Uncertainty: half the distance between where p is 0.25 and 0.75, at most a voxel edge; about a quarter of an edge
/// where the map is sure. Watertight. Empty, with the reason, if no voxel is measured or none that is measured is
/// occupied. The same on any number of threads.
/// @throws std::invalid_argument if the number of voxels is not the grid's, or a probability is not finite.
Surface map_surface(const VoxelGrid& grid, std::span<const Voxel> voxels);
/// The same of a map's voxels as they are kept; with a prior of a Gibbs map's, of which those that the measurements
/// hardly moved from it count as not measured (DecidedVoxels). What it takes grows with the object, not with the
/// region.
Surface map_surface(const VoxelGrid& grid, const VoxelBricks& voxels, std::optional<double> prior = {});

}  // namespace nextview

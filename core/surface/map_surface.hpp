#pragma once
#include <span>
#include <vector>

#include "core/map/occupancy.hpp"
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

/// A Gibbs map as map_surface should see it: voxels whose odds the measurements have left within a factor of two of the
/// `prior` probability's count as not measured. Rays reach into walls that attenuate them weakly and say nothing there;
/// taken for free, walls would be hollow.
std::vector<Voxel> without_undecided(std::span<const Voxel> voxels, double prior);

}  // namespace nextview

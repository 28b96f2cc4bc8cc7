#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/grid_margin.hpp"
#include "core/map/huge_pages.hpp"

namespace nextview {

/// Rays of one camera through the voxels of a grid.
struct RaysThroughGrid {
  const VoxelGrid& grid;
  Vector3 origin;                       ///< [m, world]
  std::span<const Vector3> directions;  ///< of unit length, world
  double max_range;                     ///< [m]
};

/// What a ray finds in the voxels of a grid. Voxels in few states, as those of an occupancy map, are kept as numbers of
/// these: a byte each where that is enough, else two. Where every voxel differs (a Gibbs map) `worth` and `passes` have
/// one entry a place instead.
struct StateField {
  static constexpr std::size_t outside = 1;      ///< state of the margin
  static constexpr std::size_t read_beyond = 8;  ///< bytes behind the last state, which are read along with it

  /// Twice the number of the state, and 1 if a ray goes no farther; by place_with_margin. At most one is not empty.
  std::vector<std::uint8_t, HugePages<std::uint8_t>> bytes;
  std::vector<std::uint16_t, HugePages<std::uint16_t>> shorts;
  /// What a voxel adds, times the ray's visibility. By the state's number, 0 for the margin; without states by place.
  std::vector<double> worth;
  /// What share of the visibility goes on; 1 - p. Without states its sign bit says that a ray goes no farther, and the
  /// margin has -2.
  std::vector<double> passes;
  double most_worth = 0.0;  ///< of any voxel, where passes are at most 1
};

/// The sum of visibility times worth of each ray, voxel by voxel up to the one that ends it: to the last bit what the
/// plain walk (walk_ray) adds up, on any instruction set. A ray is given up where nothing that it might still add can
/// change its sum. Returns how many voxels were looked at.
std::size_t sum_along_rays(const RaysThroughGrid& rays, const StateField& field, std::span<double> sums);

/// What rays find on their way, ray after ray.
struct Finds {
  struct Find {
    std::uint32_t place;  ///< with margin
    double area;          ///< across the ray, per solid angle [m^2]
  };
  std::vector<Find> finds;
  std::vector<std::size_t> begins;  ///< of each ray's
  std::vector<std::size_t> ends;
};

/// Voxels as NewSurfaceField has them, a chance each, with a margin of `outside`.
struct ChanceField {
  static constexpr float outside = 2.0f;  ///< is no probability
  std::span<const float> chances;         ///< by place_with_margin
  double negligible;                      ///< reach at which a ray is given up
};

/// The new surface that each ray is expected to find in each voxel, range^2 reach |chance|, as the plain walk
/// (walk_ray_segments) does, to the last bit.
Finds find_along_rays(const RaysThroughGrid& rays, const ChanceField& field);

}  // namespace nextview

#pragma once
#include <vector>

#include "core/gibbs/posterior_sampler_config.hpp"
#include "core/gibbs/ray_lists.hpp"
#include "core/map/bit_rows.hpp"

namespace nextview {

/// The voxels that a chain updates: those that a ray may have ended in, and those that it can only have passed. The
/// latter are many, and nearly all of them stay free.
struct Sites {
  enum Kind : std::uint8_t { none, front, near };
  std::vector<std::uint32_t> near_voxels, front_voxels;  ///< brick after brick
  std::vector<Kind> kind;                                ///< per voxel of the grid

  std::size_t count() const { return near_voxels.size() + front_voxels.size(); }
};

/// All that rays observe; with UpdatedVoxels::occupied those of them where the start map has p >= 0.5. Of voxels that
/// no range is near only those that a ray from `first_ray` on passes.
Sites find_sites(const RayLists& lists, const PosteriorSamplerConfig& config, std::span<const float> start_map,
                 std::uint32_t first_ray = 0);

/// Of which the read-out changes with those sites' levels and rays: they, and the voxels up to two away from where a
/// ray may have ended, as far as planes through such places reach.
BitRows voxels_read_out(const VoxelGrid& grid, const Sites& sites);
/// Those, and the 26 around each.
BitRows with_neighbours(BitRows voxels);

/// The map that a chain starts from (PosteriorSamplerConfig::start): voxels that no ray observes are free.
std::vector<std::uint8_t> start_levels(const RayLists& lists, const PosteriorSamplerConfig& config,
                                       std::span<const float> start_map, int chain);

}  // namespace nextview

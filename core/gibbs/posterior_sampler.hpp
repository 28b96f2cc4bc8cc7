#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string_view>
#include <vector>

#include "core/gibbs/gibbs_posterior.hpp"
#include "core/gibbs/posterior_sampler_config.hpp"
#include "core/gibbs/ray_lists.hpp"

namespace nextview {

/// Where a run goes on from: its chains start with the maps of an earlier one, and leave out half as many sweeps.
struct WarmStart {
  std::span<const std::vector<std::uint8_t>> states = {};  ///< GibbsPosterior::states
  /// If given, the posterior of the rays before `first_new_ray` of the lists. Voxels that only those pass, and no ray
  /// ends near, keep what it says of them, and their levels stay as they were drawn: an approximation, as other rays
  /// change little of what is known of them.
  const GibbsPosterior* kept = nullptr;
  std::uint32_t first_new_ray = 0;
};

/// Is given every few sweeps how far a run has come, which never goes back, and how it goes: `so_far` has the traces up
/// to now, what is worked out from them as of the last mean that was tried. It is valid during the call. Called from
/// the thread that samples.
using SamplerProgress = std::function<void(double fraction, std::string_view what, const SamplerDiagnostics& so_far)>;

/// What SamplerProgress is told before the first sweep.
inline constexpr std::string_view listing_rays = "listing the rays of each voxel";

/// Draws from p(m | z), z being the rays of lists. `start_map`: probabilities that StartMap::octree starts from
/// (occupied where p >= 0.5), and that UpdatedVoxels::occupied updates; empty: all free. The same bytes on any number
/// of threads; a requested stop ends the sweeps early and the diagnostics say so. The sensor model is that of the
/// lists, PosteriorSamplerConfig::ray_spacing has no say.
/// @throws std::invalid_argument for a configuration out of bounds, or a start that is of another grid or model, or
/// keeps voxels though not all are updated.
GibbsPosterior sample_posterior(const RayLists& lists, const PosteriorSamplerConfig& config,
                                std::span<const float> start_map = {}, const WarmStart& warm = {},
                                const SamplerProgress& progress = {}, std::stop_token stop = {});

/// The same of measurements: merges them by PosteriorSamplerConfig::ray_spacing and lists them first.
/// @throws std::invalid_argument also for rays that would not fit into memory.
GibbsPosterior sample_posterior(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                const PosteriorSamplerConfig& config, std::span<const float> start_map = {},
                                const WarmStart& warm = {}, const SamplerProgress& progress = {},
                                std::stop_token stop = {});

}  // namespace nextview

#include "core/session/map_refinement.hpp"

#include <algorithm>

namespace nextview {

MapRefinement::MapRefinement(const VoxelGrid& grid, const PosteriorSamplerConfig& config,
                             const InverseSensorModel& classes, double max_range)
    : config_(config), classes_(classes), measurements_{max_range, {}, {}}, voxels_(grid.voxel_count()) {
  config_.validate();
  posterior_.grid = grid;
}

void MapRefinement::add(const Scan& scan) {
  RangeMeasurements view{measurements_.max_range, {}, {}};
  view.add(scan);
  measured_rays_ += view.rays.size();
  measurements_.append(join_rays(view, posterior_.grid, config_.ray_spacing));
}

void MapRefinement::refine(std::span<const float> conventional, int sweeps, const SamplerProgress& progress,
                           std::stop_token stop) {
  PosteriorSamplerConfig config = config_;
  config.ray_spacing = 0.0;             // they are joined
  config.seed += refinements_++ << 32;  // other numbers than the last time
  config.until_stationary = sweeps == 0;
  if (sweeps > 0) config.sweeps = sweeps;
  config.burn_in = std::min(config.burn_in, config.sweeps / 2);
  posterior_ =
      sample_posterior(posterior_.grid, measurements_, config, conventional, posterior_.states, progress, stop);
  posterior_.diagnostics.measured_rays = measured_rays_;
  std::ranges::copy(posterior_.voxels(classes_), voxels_.begin());
}

void MapRefinement::go_back(const MapRefinement& before) {
  std::vector<Voxel> voxels = std::move(voxels_);  // where rays look for them
  *this = before;
  voxels_ = std::move(voxels);
  std::ranges::copy(before.voxels_, voxels_.begin());
}

OccupancyMap to_occupancy_map(const GibbsPosterior& posterior, const InverseSensorModel& classes) {
  InverseSensorModel model = classes;
  model.clamp_min = 1e-6;
  model.clamp_max = 1.0 - 1e-6;
  OccupancyMap map(posterior.grid, model);
  for (std::uint32_t v = 0; v < posterior.occupied.size(); ++v)
    if (posterior.informed[v])
      map.set_log_odds(
          v, static_cast<float>(log_odds(std::clamp<double>(posterior.occupied[v], model.clamp_min, model.clamp_max))));
  return map;
}

}  // namespace nextview

#include "core/gibbs/gibbs_state.hpp"

#include <algorithm>

namespace nextview {

GibbsState::GibbsState(const VoxelGrid& grid, const PosteriorSamplerConfig& config, const InverseSensorModel& classes)
    : config_(config),
      classes_(classes),
      measurements_(std::make_shared<const RangeMeasurements>()),
      posterior_(std::make_shared<const GibbsPosterior>(GibbsPosterior{grid, {}, {}, {}, {}, {}, {}})),
      voxels_(grid.size) {
  config_.validate();
}

void GibbsState::add(const Scan& scan) {
  auto all = std::make_shared<RangeMeasurements>(*measurements_);
  if (all->origins.empty()) all->max_range = measurements_of(std::span(&scan, 1)).max_range;  // refuses one without
  RangeMeasurements view{all->max_range, {}, {}};
  view.add(scan);
  all->append(merge_rays(view, posterior_->grid, config_.ray_spacing));
  measured_rays_ += view.rays.size();
  measurements_ = std::move(all);
}

void GibbsState::refine(std::span<const float> conventional, int sweeps, const SamplerProgress& progress,
                        std::stop_token stop) {
  PosteriorSamplerConfig config = config_;
  config.ray_spacing = 0.0;             // they are merged
  config.seed += refinements_++ << 32;  // other numbers than the last time
  config.until_stationary = sweeps == 0;
  if (sweeps > 0) config.sweeps = sweeps;
  config.burn_in = std::min(config.burn_in, config.sweeps / 2);
  auto posterior = std::make_shared<GibbsPosterior>(
      sample_posterior(posterior_->grid, *measurements_, config, conventional, posterior_->states, progress, stop));
  posterior->diagnostics.measured_rays = measured_rays_;
  voxels_ = VoxelBricks(posterior->grid.size, posterior->voxels(classes_));
  posterior_ = std::move(posterior);
}

std::size_t GibbsState::bytes(const GibbsState* other) const {
  std::size_t bytes = other ? voxels_.bytes_beside(other->voxels_) : voxels_.bytes();
  if (!other || measurements_ != other->measurements_) bytes += measurements_->rays.size() * sizeof(RangeMeasurement);
  if (other && posterior_ == other->posterior_) return bytes;
  const GibbsPosterior& p = *posterior_;
  bytes += p.occupied.size() * (sizeof p.occupied[0] + sizeof p.upper[0] + sizeof p.informed[0]) +
           p.touch.size() * (sizeof p.touch[0] + sizeof p.centre[0]);
  for (const auto& state : p.states) bytes += state.size();
  return bytes;
}

OccupancyMap to_occupancy_map(const GibbsPosterior& posterior, const InverseSensorModel& classes) {
  InverseSensorModel model = classes;
  model.clamp_min = 1e-6;
  model.clamp_max = 1.0 - 1e-6;
  OccupancyMap map(posterior.grid, model);
  for (std::uint32_t v = 0; v < posterior.occupied.size(); ++v)
    if (posterior.informed[v])
      map.set_log_odds(
          v, static_cast<float>(log_odds(std::clamp<double>(posterior.touch[v], model.clamp_min, model.clamp_max))));
  return map;
}

}  // namespace nextview

#include "core/gibbs/gibbs_state.hpp"

#include <algorithm>

#include "core/memory/available_memory.hpp"
#include "core/progress/stopwatch.hpp"

namespace nextview {
namespace {

constexpr std::size_t most_kept = std::size_t{1} << 30;  ///< lists larger than this are made anew each time [bytes]

}  // namespace

GibbsState::GibbsState(const VoxelGrid& grid, const PosteriorSamplerConfig& config, const InverseSensorModel& classes)
    : config_(config),
      classes_(classes),
      measurements_(std::make_shared<const RangeMeasurements>()),
      refined_(measurements_),
      latest_lists_(std::make_shared<LatestLists>()),
      posterior_(std::make_shared<const GibbsPosterior>(GibbsPosterior{grid, {}, {}, {}, {}, {}, {}})),
      voxels_(grid.size) {
  config_.validate();
}

void GibbsState::add(const Scan& scan) {
  const RangeMeasurements& before = *measurements_;
  const double max_range = before.origins.empty()
                               ? measurements_of(std::span(&scan, 1)).max_range  // refuses one without
                               : before.max_range;
  RangeMeasurements view{max_range, {}, {}};
  view.add(scan);
  view.validate();
  const RangeMeasurements merged = merge_rays(view, posterior_->grid, config_.ray_spacing);
  auto all = std::make_shared<RangeMeasurements>(RangeMeasurements{max_range, {}, {}});
  all->rays.reserve(before.rays.size() + merged.rays.size());  // they are many: they are copied once
  all->append(before);
  all->append(merged);
  if (independence_follows_from_hits(config_.model)) hits_.add(hit_cells(merged, posterior_->grid));
  measured_rays_ += view.rays.size();
  measurements_ = std::move(all);
}

/// The lists of all rays: the latest with what was added since, if they are of the rays that this posterior knows.
std::unique_ptr<RayLists> GibbsState::take_lists(const ForwardSensorModel& model, const std::stop_token& stop) const {
  std::unique_ptr<RayLists> lists;
  {
    const std::scoped_lock lock(latest_lists_->mutex);
    lists = std::move(latest_lists_->lists);
    if (latest_lists_->measurements != refined_) lists = nullptr;
  }
  try {
    if (lists && measurements_ != refined_) lists->append(measurements_->after(*refined_), stop);
  } catch (const OutOfMemory&) {  // to grow they are there twice for a moment
    lists = nullptr;
  }
  if (!lists) return std::make_unique<RayLists>(posterior_->grid, *measurements_, model, stop);
  lists->set_independence(model.independence);
  return lists;
}

void GibbsState::refine(const VoxelBricks* conventional, int sweeps, const SamplerProgress& progress,
                        std::stop_token stop) {
  PosteriorSamplerConfig config = config_;
  config.seed += refinements_ << 32;  // other numbers than the last time
  config.until_stationary = sweeps == 0;
  if (sweeps > 0) config.sweeps = sweeps;
  config.burn_in = std::min(config.burn_in, config.sweeps / 2);
  if (progress) progress(0.0, listing_rays, {});
  double build_seconds = 0.0;
  std::unique_ptr<RayLists> lists = [&] {
    const Stopwatch watch(build_seconds);
    return take_lists(with_independence(config.model, hits_), stop);
  }();
  const bool grows = sweeps > 0 && !refined_->rays.empty() && refined_ != measurements_ &&
                     config.updated == UpdatedVoxels::occupied_and_free;
  const WarmStart warm{posterior_->states, grows ? posterior_.get() : nullptr,
                       lists->first_ray_of(static_cast<std::uint32_t>(refined_->origins.size()))};
  // Where the maps go on from those that are there nobody asks for it.
  const auto start_map = conventional && !grows ? probabilities(*conventional) : std::vector<float>();
  auto posterior = std::make_shared<GibbsPosterior>(sample_posterior(*lists, config, start_map, warm, progress, stop));
  posterior->diagnostics.measured_rays = measured_rays_;
  posterior->diagnostics.build_seconds = build_seconds;
  voxels_ = posterior->bricks(classes_);
  posterior_ = std::move(posterior);
  refined_ = measurements_;
  ++refinements_;
  if (sweeps == 0 || stop.stop_requested() || lists->bytes() > most_kept) return;
  const std::scoped_lock lock(latest_lists_->mutex);
  latest_lists_->measurements = refined_;
  latest_lists_->lists = std::move(lists);
}

void GibbsState::forget_lists() const {
  const std::scoped_lock lock(latest_lists_->mutex);
  latest_lists_->lists = nullptr;
}

std::size_t GibbsState::bytes(const GibbsState* other) const {
  std::size_t bytes = other ? voxels_.bytes_beside(other->voxels_) : voxels_.bytes();
  if (!other || measurements_ != other->measurements_) bytes += measurements_->rays.size() * sizeof(RangeMeasurement);
  if (!other || latest_lists_ != other->latest_lists_) {
    const std::scoped_lock lock(latest_lists_->mutex);
    if (latest_lists_->lists) bytes += latest_lists_->lists->bytes();
  }
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

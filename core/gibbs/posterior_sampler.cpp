#include "core/gibbs/posterior_sampler.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/gibbs/chain_ensemble.hpp"
#include "core/gibbs/independence.hpp"
#include "core/gibbs/read_out.hpp"
#include "core/memory/available_memory.hpp"
#include "core/progress/stopwatch.hpp"

namespace nextview {
namespace {

/// Sweeps of the first mean that is tried; the usual chain is white noise by then.
constexpr int first_window = SamplerDiagnostics::fewest_telling_sweeps;
constexpr int sweeps_of_r_hat = 4;  ///< that R-hat needs for its halves
constexpr int sweeps_between_reports = 4;
constexpr double done_of_first_test = 0.9;  ///< most chains are stationary then; the rest is for those that are not

/// Sweeps until stopped, stationary, or all sweeps are made.
class Schedule {
 public:
  Schedule(ChainEnsemble& chains, const PosteriorSamplerConfig& config, SamplerDiagnostics& diagnostics,
           const SamplerProgress& progress, std::stop_token stop)
      : chains_(chains), config_(config), diagnostics_(diagnostics), progress_(progress), stop_(stop) {}

  void run(bool warm) {
    const int burn_in =
        std::min(warm ? config_.burn_in / 2 : config_.burn_in, std::max(0, config_.sweeps - sweeps_of_r_hat));
    const int first = config_.until_stationary ? first_window : config_.sweeps;
    may_end_ = std::min(burn_in + first, config_.sweeps);
    next_done_ = config_.until_stationary ? done_of_first_test : 1.0;
    sweep(burn_in, false);
    // Where a start is still felt, or seems to be, the next mean is of as many sweeps, those after it of twice as many.
    if (ends_in_mean_of(first)) return;
    for (int window = first; !ends_in_mean_of(window); window *= 2) {
    }
  }

 private:
  /// Sweeps into a new mean, and says whether that is the last. Tests of so few sweeps fail by chance, too: as long as
  /// there is no trend, a quarter more are asked for, up to twice as many. A start that is still felt is left out, if
  /// sweeps are left for a mean of as many.
  bool ends_in_mean_of(int window) {
    chains_.begin_mean(std::min(window, config_.sweeps - diagnostics_.sweeps));
    for (int next = window;; next = window / 4) {
      const int count = std::max(sweeps_of_r_hat, std::min(next, config_.sweeps - diagnostics_.sweeps));
      go_on_to(diagnostics_.sweeps + count);
      sweep(count, true);
      chains_.diagnose();
      report();
      const int taken = diagnostics_.sweeps - diagnostics_.burn_in, left = config_.sweeps - diagnostics_.sweeps;
      if (diagnostics_.stationary && config_.until_stationary) return true;
      if (stop_.stop_requested() || left < sweeps_of_r_hat) return true;
      if (left >= taken && (chains_.trends() || taken >= 2 * window)) return false;
    }
  }

  void sweep(int count, bool into_mean) {
    for (int done = 0; done < count; ++done) {
      const bool stops = stop_.stop_requested();
      if (stops && (!into_mean || done >= sweeps_of_r_hat)) return;
      if (stops || done % sweeps_between_reports == 0) report();
      chains_.sweep(into_mean);
    }
  }

  /// Sweeps that were not enough leave half as much of the bar to those after them: it is never full before the end,
  /// and never goes back.
  void go_on_to(int end) {
    if (end == may_end_) return;
    began_ = diagnostics_.sweeps;
    may_end_ = end;
    done_ = std::exchange(next_done_, (1.0 + next_done_) / 2);
  }

  void report() {
    // Of what it takes until it is asked again whether that is enough.
    const double share = std::min(1.0, double(diagnostics_.sweeps - began_) / std::max(1, may_end_ - began_));
    if (progress_) progress_(done_ + share * (next_done_ - done_), "refining the map", diagnostics_);
  }

  ChainEnsemble& chains_;
  const PosteriorSamplerConfig& config_;
  SamplerDiagnostics& diagnostics_;
  const SamplerProgress& progress_;
  std::stop_token stop_;
  int began_ = 0, may_end_ = 1;          ///< after so many sweeps it was, and will be, asked whether they are enough
  double done_ = 0.0, next_done_ = 0.0;  ///< of the whole, as told then
};

std::string warning(const SamplerDiagnostics& d) {
  if (d.stopped) return fmt::format("stopped after {} sweep{}", d.sweeps, d.sweeps == 1 ? "" : "s");
  if (d.merged_rays == 0) return "no ray enters the region: nothing is informed";
  if (d.stationary) return "";
  if (d.too_short_to_tell())
    return fmt::format("{} sweeps are too few to tell whether the chains are stationary", d.sweeps);
  return fmt::format(
      "not stationary after {} sweeps: R-hat {:.3f} (wanted: under 1.05), trend |z| {:.1f} (under 2.58), {:.0f} "
      "effective samples (10), {} voxels differ between chains (at most {}); more sweeps may help",
      d.sweeps, d.r_hat, d.trend, d.effective_samples, d.disagreeing_voxels, d.informed_voxels / 10000);
}

/// As the levels were drawn that the read-out was fitted to.
bool draws_as_fitted(const PosteriorSamplerConfig& config) {
  const PosteriorSamplerConfig usual;
  return config.model.kind == ForwardModel::attenuation && config.model.attenuations == usual.model.attenuations &&
         config.prior == usual.prior && config.sampler == Sampler::exact &&
         config.updated == UpdatedVoxels::occupied_and_free;
}

void read_out(GibbsPosterior& posterior, const RayLists& lists, const Sites* sites,
              const PosteriorSamplerConfig& config) {
  if (config.read_out == ReadOut::fitted && draws_as_fitted(config)) {
    if (!sites) return read_out(posterior, read_out_rays(lists), fitted_read_out());
    const BitRows asked = voxels_read_out(lists.grid(), *sites);
    read_out(posterior, read_out_rays(lists, with_neighbours(asked)), fitted_read_out(), &asked);
  } else {
    posterior.touch = posterior.centre = posterior.occupied;
  }
}

void sample(GibbsPosterior& posterior, const RayLists& lists, const Sites& sites, const PosteriorSamplerConfig& config,
            std::span<const float> start_map, const WarmStart& warm, const SamplerProgress& progress,
            std::stop_token stop) {
  SamplerDiagnostics& d = posterior.diagnostics;
  const Stopwatch watch(d.sample_seconds);
  std::size_t kept = 0;
  for (std::size_t v = 0; warm.kept && v < sites.kind.size(); ++v)
    kept += sites.kind[v] == Sites::none && warm.kept->informed[v];
  ChainEnsemble chains(lists, config, sites, kept, d);
  tbb::parallel_for(0, config.chains, [&](int c) {
    auto levels = std::size_t(c) < warm.states.size() ? warm.states[c] : start_levels(lists, config, start_map, c);
    // What is never updated stays free: it would stand in the rays' way for ever.
    for (std::size_t v = 0; v < levels.size() && !warm.kept; ++v)
      if (sites.kind[v] == Sites::none) levels[v] = 0;
    chains.start(c, std::move(levels));
  });
  Schedule(chains, config, d, progress, stop).run(!warm.states.empty());
  tbb::parallel_for(std::size_t{0}, posterior.occupied.size(), [&](std::size_t v) {
    const bool updated = sites.kind[v] != Sites::none;  // otherwise it keeps what it has
    if (!updated && warm.kept) return;
    posterior.informed[v] = chains.informed(v);
    if (!posterior.informed[v]) {
      posterior.occupied[v] = posterior.upper[v] = 0.5f;
      return;
    }
    posterior.occupied[v] = updated             ? chains.mean(v, &PosteriorSums::occupied)
                            : start_map.empty() ? 0.0f
                                                : start_map[v];
    posterior.upper[v] = updated ? chains.mean(v, &PosteriorSums::upper) : posterior.occupied[v];
  });
  read_out(posterior, lists, warm.kept ? &sites : nullptr, config);
  for (int c = 0; c < config.chains; ++c) posterior.states.emplace_back(chains.map(c).begin(), chains.map(c).end());
  if (config.keep_traces) posterior.traces = chains.take_level_traces();
}

void require_fitting(std::span<const float> start_map, const WarmStart& warm, std::size_t voxels,
                     const PosteriorSamplerConfig& config) {
  if (!start_map.empty() && start_map.size() != voxels)
    throw std::invalid_argument("gibbs: the start map is of another grid");
  for (const auto& state : warm.states)
    if (state.size() != voxels || *std::max_element(state.begin(), state.end()) >= config.model.levels())
      throw std::invalid_argument("gibbs: a warm start is of another grid or model");
  if (!warm.kept) return;
  const GibbsPosterior& kept = *warm.kept;
  const auto fits = [&](const auto& values) { return values.size() == voxels; };
  if (!fits(kept.occupied) || !fits(kept.upper) || !fits(kept.informed) || !fits(kept.touch) || !fits(kept.centre) ||
      warm.states.size() != std::size_t(config.chains))
    throw std::invalid_argument("gibbs: the posterior that is kept is of another grid, or of other chains");
  if (config.updated != UpdatedVoxels::occupied_and_free)
    throw std::invalid_argument("gibbs: a posterior is kept only where all voxels are updated");
}

/// What is known before the first sweep.
GibbsPosterior start_of(const VoxelGrid& grid, const WarmStart& warm) {
  if (warm.kept) {
    const GibbsPosterior& kept = *warm.kept;
    return {grid, kept.occupied, kept.upper, kept.informed, {}, {}, {}, kept.touch, kept.centre};
  }
  const std::vector<float> unknown(grid.voxel_count(), 0.5f);
  return {grid, unknown, unknown, std::vector<std::uint8_t>(unknown.size(), 0), {}, {}, {}};
}

}  // namespace

GibbsPosterior sample_posterior(const RayLists& lists, const PosteriorSamplerConfig& configured,
                                std::span<const float> start_map, const WarmStart& warm,
                                const SamplerProgress& progress, std::stop_token stop) {
  PosteriorSamplerConfig config = configured;
  config.model = lists.model();
  config.validate();
  const std::size_t voxels = lists.grid().voxel_count();
  require_fitting(start_map, warm, voxels, config);
  constexpr std::uint64_t of_chain = 32, of_posterior = 35;  // [bytes a voxel] map, state and sums; means and read-outs
  require_memory(voxels * (of_chain * std::uint64_t(config.chains) + of_posterior),
                 fmt::format("gibbs: {} chains of {} voxels", config.chains, voxels),
                 "use fewer chains (gibbs.chains) or a coarser map");
  GibbsPosterior posterior = start_of(lists.grid(), warm);
  const Sites sites = find_sites(lists, config, start_map, warm.kept ? warm.first_new_ray : 0);
  SamplerDiagnostics& d = posterior.diagnostics;
  d.merged_rays = lists.rays();
  d.observed_voxels = sites.count();
  d.incidences = lists.incidence_count();
  d.list_bytes = lists.bytes();
  sample(posterior, lists, sites, config, start_map, warm, progress, stop);
  d.stopped = stop.stop_requested();
  if (d.stopped || d.few_sweeps()) d.stationary = false;  // asked early, it would say so by chance
  d.warning = warning(d);
  return posterior;
}

GibbsPosterior sample_posterior(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                const PosteriorSamplerConfig& config, std::span<const float> start_map,
                                const WarmStart& warm, const SamplerProgress& progress, std::stop_token stop) {
  config.validate();
  measurements.validate();
  RayLists::require_holdable(grid);
  require_fitting(start_map, warm, grid.voxel_count(), config);
  if (progress) progress(0.0, listing_rays, {});
  double build_seconds = 0.0;
  const RayLists lists = [&] {
    const Stopwatch watch(build_seconds);
    const RangeMeasurements merged = merge_rays(measurements, grid, config.ray_spacing);
    return RayLists(grid, merged, with_independence(config.model, merged, grid));
  }();
  GibbsPosterior posterior = sample_posterior(lists, config, start_map, warm, progress, stop);
  posterior.diagnostics.measured_rays = measurements.rays.size();
  posterior.diagnostics.build_seconds = build_seconds;
  return posterior;
}

}  // namespace nextview

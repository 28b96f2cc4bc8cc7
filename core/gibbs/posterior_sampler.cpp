#include "core/gibbs/posterior_sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/gibbs/chain_ensemble.hpp"
#include "core/gibbs/independence.hpp"
#include "core/gibbs/read_out.hpp"
#include "core/memory/available_memory.hpp"
#include "core/progress/stopwatch.hpp"

namespace nextview {
namespace {

constexpr int first_window = 10;  ///< sweeps of the first mean that is tried; the usual chain is white noise by then
constexpr int few_sweeps = 4;     ///< that R-hat needs for its halves
constexpr int sweeps_between_reports = 4;

/// Sweeps until stopped, stationary, or all sweeps are made.
class Schedule {
 public:
  Schedule(ChainEnsemble& chains, const PosteriorSamplerConfig& config, SamplerDiagnostics& diagnostics,
           const SamplerProgress& progress, std::stop_token stop)
      : chains_(chains), config_(config), diagnostics_(diagnostics), progress_(progress), stop_(stop) {}

  void run(bool warm) {
    const int burn_in =
        std::min(warm ? config_.burn_in / 2 : config_.burn_in, std::max(0, config_.sweeps - few_sweeps));
    const int first = config_.until_stationary ? first_window : config_.sweeps;
    may_end_ = std::min(burn_in + first, config_.sweeps);
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
      const int count = std::max(few_sweeps, std::min(next, config_.sweeps - diagnostics_.sweeps));
      may_end_ = diagnostics_.sweeps + count;
      sweep(count, true);
      chains_.diagnose();
      report();
      const int taken = diagnostics_.sweeps - diagnostics_.burn_in, left = config_.sweeps - diagnostics_.sweeps;
      if (diagnostics_.stationary && config_.until_stationary) return true;
      if (stop_.stop_requested() || left < few_sweeps) return true;
      if (left >= taken && (chains_.trends() || taken >= 2 * window)) return false;
    }
  }

  void sweep(int count, bool into_mean) {
    for (int done = 0; done < count; done += sweeps_between_reports) {
      if (stop_.stop_requested() && (!into_mean || done >= few_sweeps)) return;
      report();
      chains_.sweep(std::min(sweeps_between_reports, count - done), into_mean);
    }
  }

  void report() {
    // Of what it takes until it is asked again whether that is enough.
    done_ = std::max(done_, std::min(1.0, double(diagnostics_.sweeps) / may_end_));
    if (progress_) progress_(done_, "refining the map", diagnostics_);
  }

  ChainEnsemble& chains_;
  const PosteriorSamplerConfig& config_;
  SamplerDiagnostics& diagnostics_;
  const SamplerProgress& progress_;
  std::stop_token stop_;
  double done_ = 0.0;  ///< as told last: it never goes back
  int may_end_ = 1;    ///< after so many sweeps it is asked whether they are enough
};

std::string warning(const SamplerDiagnostics& d, bool stopped) {
  if (stopped) return fmt::format("stopped after {} sweeps", d.sweeps);
  if (d.merged_rays == 0) return "no ray enters the region: nothing is informed";
  if (d.stationary) return "";
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

void read_out(GibbsPosterior& posterior, const RayLists& lists, const PosteriorSamplerConfig& config) {
  if (config.read_out == ReadOut::fitted && draws_as_fitted(config)) {
    read_out(posterior, read_out_rays(lists), fitted_read_out());
  } else {
    posterior.touch = posterior.centre = posterior.occupied;
  }
}

/// The rays by voxel, and the voxels that are updated.
struct ListedRays {
  RayLists lists;
  Sites sites;
};

/// Merges and lists them; the model learns how independent they are.
ListedRays list_rays(const VoxelGrid& grid, const RangeMeasurements& measurements, PosteriorSamplerConfig& config,
                     std::span<const float> start_map, SamplerDiagnostics& d) {
  const Stopwatch watch(d.build_seconds);
  const RangeMeasurements merged = merge_rays(measurements, grid, config.ray_spacing);
  config.model = with_independence(config.model, merged, grid);
  RayLists lists(grid, merged, config.model);
  Sites sites = find_sites(lists, config, start_map);
  d.measured_rays = measurements.rays.size();
  d.merged_rays = lists.rays();
  d.observed_voxels = sites.count();
  d.incidences = lists.incidence_count();
  d.list_bytes = lists.bytes();
  return {std::move(lists), std::move(sites)};
}

void sample(GibbsPosterior& posterior, const ListedRays& rays, const PosteriorSamplerConfig& config,
            std::span<const float> start_map, std::span<const std::vector<std::uint8_t>> warm,
            const SamplerProgress& progress, std::stop_token stop) {
  SamplerDiagnostics& d = posterior.diagnostics;
  const Stopwatch watch(d.sample_seconds);
  ChainEnsemble chains(rays.lists, config, rays.sites, d);
  for (int c = 0; c < config.chains; ++c) {
    auto levels = std::size_t(c) < warm.size() ? warm[c] : start_levels(rays.lists, config, start_map, c);
    // What is never updated stays free: it would stand in the rays' way for ever.
    for (std::size_t v = 0; v < levels.size(); ++v)
      if (rays.sites.kind[v] == Sites::none) levels[v] = 0;
    chains.start(c, std::move(levels));
  }
  Schedule(chains, config, d, progress, stop).run(!warm.empty());
  for (std::size_t v = 0; v < posterior.occupied.size(); ++v) {
    posterior.informed[v] = chains.informed(v);
    if (!posterior.informed[v]) continue;
    const bool updated = rays.sites.kind[v] != Sites::none;  // otherwise it keeps what it has
    posterior.occupied[v] = updated             ? chains.mean(v, &PosteriorSums::occupied)
                            : start_map.empty() ? 0.0f
                                                : start_map[v];
    posterior.upper[v] = updated ? chains.mean(v, &PosteriorSums::upper) : posterior.occupied[v];
  }
  read_out(posterior, rays.lists, config);
  for (int c = 0; c < config.chains; ++c) posterior.states.emplace_back(chains.map(c).begin(), chains.map(c).end());
  if (config.keep_traces) posterior.traces = chains.take_level_traces();
}

}  // namespace

std::vector<Setting> settings(PosteriorSamplerConfig& c) {
  return {
      {"gibbs.prior", "", "of a voxel being occupied (at any level but free)", &c.prior, between(0, 1)},
      {"gibbs.sampler", "", "draw from the full conditional, or Algorithm 1 as printed",
       choice(c.sampler, {"exact", "algorithm1"})},
      {"gibbs.updated", "", "voxels that are updated", choice(c.updated, {"occupied-and-free", "occupied"})},
      {"gibbs.start", "", "map that the chains start from", choice(c.start, {"octree", "free", "occupied", "random"})},
      {"gibbs.swaps", "", "passes of neighbour swaps per sweep; -1: none with attenuation, else 1", &c.swaps,
       from_to(-1, 15)},
      {"gibbs.plaquettes", "", "passes of 2 x 2 plaquettes per sweep", &c.plaquettes, from_to(0, 15)},
      {"gibbs.chains", "", "independent chains, a thread each", &c.chains, from_to(1, 64)},
      {"gibbs.sweeps", "", "sweeps of each chain, at most", &c.sweeps, from_to(4, 1e6)},
      {"gibbs.burn_in", "", "sweeps before the first mean that is tried", &c.burn_in, from_to(0, 1e6)},
      {"gibbs.until_stationary", "", "stop as soon as the chains are stationary", &c.until_stationary},
      {"gibbs.read_out", "", "probabilities: as learned from made-up parts, or of the levels as they are",
       choice(c.read_out, {"fitted", "levels"})},
      {"gibbs.ray_spacing", "", "rays nearer to each other than this are merged [voxel edges]; 0: none", &c.ray_spacing,
       from_to(0, 100)},
  };
}

void PosteriorSamplerConfig::validate() const {
  model.validate();
  require_in_bounds(*this);
}

std::vector<Voxel> GibbsPosterior::voxels_of(std::span<const float> p, const InverseSensorModel& classes) const {
  std::vector<Voxel> voxels(p.size());
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    voxels[v].probability = p[v];
    voxels[v].entropy = static_cast<float>(entropy(p[v]));
    voxels[v].voxel_class = classes.classify(p[v]);
    voxels[v].measured = informed[v];
  }
  return voxels;
}

GibbsPosterior sample_posterior(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                const PosteriorSamplerConfig& configured, std::span<const float> start_map,
                                std::span<const std::vector<std::uint8_t>> warm, const SamplerProgress& progress,
                                std::stop_token stop) {
  configured.validate();
  PosteriorSamplerConfig config = configured;
  measurements.validate();
  RayLists::require_holdable(grid);
  const std::size_t voxels = grid.voxel_count();
  for (const auto& state : warm)
    if (state.size() != voxels || *std::max_element(state.begin(), state.end()) >= config.model.levels())
      throw std::invalid_argument("gibbs: a warm start is of another grid or model");
  if (!start_map.empty() && start_map.size() != voxels)
    throw std::invalid_argument("gibbs: the start map is of another grid");
  GibbsPosterior posterior{grid,
                           std::vector<float>(voxels, 0.5f),
                           std::vector<float>(voxels, 0.5f),
                           std::vector<std::uint8_t>(voxels, 0),
                           {},
                           {},
                           {}};
  SamplerDiagnostics& d = posterior.diagnostics;
  if (progress) progress(0.0, "listing the rays of each voxel", d);
  const ListedRays rays = list_rays(grid, measurements, config, start_map, d);
  constexpr std::uint64_t bytes_per_voxel = 32;  // of a chain's map, state and sums
  require_memory(bytes_per_voxel * voxels * std::uint64_t(config.chains),
                 fmt::format("gibbs: {} chains of {} voxels", config.chains, voxels),
                 "use fewer chains (gibbs.chains) or a coarser map");
  sample(posterior, rays, config, start_map, warm, progress, stop);
  if (stop.stop_requested()) d.stationary = false;  // asked early, it would say so by chance
  d.warning = warning(d, stop.stop_requested());
  return posterior;
}

}  // namespace nextview

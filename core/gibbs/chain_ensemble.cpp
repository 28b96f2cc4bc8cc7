#include "core/gibbs/chain_ensemble.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nextview {
namespace {

constexpr std::size_t reach_incidences = 300'000'000;  ///< that a chain looks at for the reach of voxels, about
constexpr std::size_t traced_voxels = 500;
constexpr double largest_r_hat = 1.05;
constexpr double largest_trend = 2.576;   ///< |z| at p = 0.01
constexpr double max_disagreeing = 1e-4;  ///< of the informed voxels
/// Of the log-posterior; of few sweeps a share of as many values is enough.
constexpr double fewest_samples = 10.0, least_sample_share = 0.5;

/// Binary divergence D_KL(p || q) [nats], both kept off 0 and 1.
double divergence(double p, double q) {
  p = std::clamp(p, 1e-6, 1.0 - 1e-6);
  q = std::clamp(q, 1e-6, 1.0 - 1e-6);
  return p * std::log(p / q) + (1.0 - p) * std::log((1.0 - p) / (1.0 - q));
}

double quantile(std::vector<double>& values, double share, double otherwise) {
  if (values.empty()) return otherwise;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

ChainEnsemble::ChainEnsemble(const RayLists& lists, const PosteriorSamplerConfig& config, const Sites& sites,
                             std::size_t informed_elsewhere, SamplerDiagnostics& diagnostics)
    : config_(config),
      sites_(sites),
      informed_elsewhere_(informed_elsewhere),
      diagnostics_(diagnostics),
      sums_(config.chains),
      traces_(config.chains),
      levels_(config.chains) {
  for (int c = 0; c < config.chains; ++c) chains_.push_back(make_chain(lists, config, sites, c));
  diagnostics_.log_posterior.resize(config.chains);
  diagnostics_.changed_voxels.resize(config.chains);
  const std::size_t step = std::max<std::size_t>(1, sites.near_voxels.size() / traced_voxels);
  for (std::size_t k = 0; k < sites.near_voxels.size(); k += step) traced_.push_back(sites.near_voxels[k]);
  if (!config.keep_traces) return;
  kept_ = sites.near_voxels;
  std::ranges::sort(kept_);
}

void ChainEnsemble::start(int chain, std::vector<std::uint8_t> levels) {
  chains_[chain]->start(std::move(levels));
  if (chain == 0) diagnostics_.chain_bytes = chains_[chain]->bytes();
}

void ChainEnsemble::begin_mean(int sweeps) {
  const std::size_t voxels = sites_.kind.size();
  window_ = sweeps;
  const std::size_t affordable = reach_incidences / std::max<std::size_t>(1, diagnostics_.incidences);
  reach_samples_ = static_cast<int>(std::clamp<std::size_t>(affordable, 2, std::clamp(sweeps / 10, 2, 1000)));
  diagnostics_.burn_in = diagnostics_.sweeps;
  diagnostics_.divergence.clear();
  tbb::parallel_for(0, config_.chains, [&](int c) {
    sums_[c] = {std::vector<double>(voxels), std::vector<double>(voxels), std::vector<float>(voxels)};
    traces_[c].assign(traced_.size(), {});
    levels_[c].clear();
  });
}

void ChainEnsemble::sweep(bool into_mean) {
  tbb::parallel_for(0, config_.chains, [&](int c) {
    if (into_mean)
      sweep_into_mean(c);
    else
      diagnostics_.changed_voxels[c].push_back(chains_[c]->sweep(nullptr));
    diagnostics_.log_posterior[c].push_back(chains_[c]->log_posterior());
  });
  ++diagnostics_.sweeps;
}

void ChainEnsemble::sweep_into_mean(int c) {
  PosteriorSums& sums = sums_[c];
  const std::vector<float> before = c == 0 ? near_means() : std::vector<float>();
  diagnostics_.changed_voxels[c].push_back(chains_[c]->sweep(&sums));
  if (!before.empty()) note_divergence(before);
  for (std::size_t t = 0; t < traced_.size(); ++t)
    traces_[c][t].push_back(chains_[c]->map()[traced_[t]] > 0 ? 1.0 : 0.0);
  if (config_.keep_traces) keep_levels(c);
  const int done = sums.near_sweeps;
  // What one chain alone finds reached often enough for all is settled; for so many samples, a longer mean has no more.
  if (done <= window_ &&
      std::int64_t{done} * reach_samples_ / window_ > std::int64_t{done - 1} * reach_samples_ / window_)
    chains_[c]->add_reach(sums, 0.5f * static_cast<float>(reach_samples_ * config_.chains));
}

void ChainEnsemble::keep_levels(int c) {
  const std::size_t bytes_per_sweep = std::max<std::size_t>(1, kept_.size()) * chains_.size();
  auto& kept = levels_[c];
  std::vector<std::uint8_t>& now = kept.emplace_back();
  for (const std::uint32_t v : kept_) now.push_back(chains_[c]->map()[v]);
  if (kept.size() > config_.max_trace_bytes / bytes_per_sweep) kept.pop_front();
}

LevelTraces ChainEnsemble::take_level_traces() {
  const auto dropped = static_cast<std::size_t>(diagnostics_.sweeps - diagnostics_.burn_in) - levels_.front().size();
  return {kept_, std::move(levels_), dropped};
}

void ChainEnsemble::diagnose() {
  // A mean that was stopped early has the present maps' word for who reaches whom.
  tbb::parallel_for(0, config_.chains, [&](int c) {
    if (sums_[c].reach_samples == 0) chains_[c]->add_reach(sums_[c], 0.5f * static_cast<float>(config_.chains));
  });
  SamplerDiagnostics& d = diagnostics_;
  std::vector<std::span<const double>> chains;
  for (const auto& trace : d.log_posterior) chains.push_back(std::span(trace).last(d.sweeps - d.burn_in));
  d.r_hat = split_r_hat(chains);
  d.effective_samples = effective_sample_size(chains);
  d.trend = 0.0;
  for (const auto chain : chains) d.trend = std::max(d.trend, std::abs(geweke_z(chain)));
  diagnose_voxels();
  count_voxels();
  const double values = double(d.sweeps - d.burn_in) * config_.chains;
  d.stationary = d.r_hat < largest_r_hat && !trends() &&
                 d.effective_samples >= std::min(fewest_samples, least_sample_share * values) &&
                 static_cast<double>(d.disagreeing_voxels) <= max_disagreeing * static_cast<double>(d.informed_voxels);
}

bool ChainEnsemble::trends() const { return diagnostics_.trend >= largest_trend; }

bool ChainEnsemble::informed(std::size_t voxel) const {
  double reach = 0.0;
  int samples = 0;
  for (const PosteriorSums& s : sums_) {
    reach += s.reach[voxel];
    samples += s.reach_samples;
  }
  return samples > 0 && reach > 0.0 && reach >= 0.5 * samples;
}

float ChainEnsemble::mean(std::size_t voxel, std::vector<double> PosteriorSums::*which) const {
  float sum = 0.0f;
  for (const PosteriorSums& s : sums_) sum += chain_mean(s, voxel, which);
  return sum / static_cast<float>(sums_.size());
}

float ChainEnsemble::chain_mean(const PosteriorSums& sums, std::size_t voxel,
                                std::vector<double> PosteriorSums::*which) const {
  const int sweeps = sites_.kind[voxel] == Sites::near ? sums.near_sweeps : sums.front_sweeps;
  return static_cast<float>((sums.*which)[voxel] / std::max(1, sweeps));
}

std::vector<float> ChainEnsemble::near_means() const {
  std::vector<float> means;
  if (sums_[0].near_sweeps > 0)
    for (const std::uint32_t v : sites_.near_voxels) means.push_back(chain_mean(sums_[0], v, &PosteriorSums::occupied));
  return means;
}

void ChainEnsemble::note_divergence(const std::vector<float>& before) {
  const std::vector<float> now = near_means();
  double sum = 0.0;
  for (std::size_t k = 0; k < now.size(); ++k)
    if (now[k] != before[k]) sum += divergence(now[k], before[k]);
  diagnostics_.divergence.push_back(sum);
}

/// R-hat and effective samples over the traced voxels that are not decided.
void ChainEnsemble::diagnose_voxels() {
  std::vector<double> r_hats, samples;
  for (std::size_t t = 0; t < traced_.size(); ++t) {
    const float p = mean(traced_[t], &PosteriorSums::occupied);
    if (p < 0.05f || p > 0.95f) continue;
    std::vector<std::span<const double>> chains;
    for (const auto& traces : traces_) chains.push_back(traces[t]);
    r_hats.push_back(split_r_hat(chains));
    samples.push_back(effective_sample_size(chains));
  }
  diagnostics_.voxel_r_hat = quantile(r_hats, 0.95, 1.0);
  diagnostics_.voxel_effective_samples =
      quantile(samples, 0.05, double(diagnostics_.sweeps - diagnostics_.burn_in) * config_.chains);
}

void ChainEnsemble::count_voxels() {
  diagnostics_.informed_voxels = informed_elsewhere_;
  diagnostics_.disagreeing_voxels = 0;
  for (std::uint32_t v = 0; v < sites_.kind.size(); ++v) {
    if (sites_.kind[v] == Sites::none || !informed(v)) continue;
    ++diagnostics_.informed_voxels;
    float lowest = 1.0f, highest = 0.0f;
    for (const PosteriorSums& s : sums_) {
      const float p = chain_mean(s, v, &PosteriorSums::occupied);
      lowest = std::min(lowest, p);
      highest = std::max(highest, p);
    }
    diagnostics_.disagreeing_voxels += highest - lowest > 0.5f;
  }
}

}  // namespace nextview

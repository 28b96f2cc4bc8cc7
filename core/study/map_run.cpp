#include <algorithm>
#include <cmath>

#include "core/evaluation/baseline_maps.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/offline/refinement.hpp"
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/progress/stopwatch.hpp"
#include "core/session/session_parts.hpp"
#include "core/study/run_result.hpp"
#include "core/study/shared_by_runs.hpp"
#include "core/view/candidate_views.hpp"

namespace nextview {
namespace {

constexpr std::size_t sweeps_shown = 30;  ///< of a chain's way to stationarity

struct MadeMap {
  std::vector<Voxel> voxels;
  std::vector<Voxel> centre;                      ///< what it says of centres
  std::optional<SamplerDiagnostics> diagnostics;  ///< of a Gibbs map
};

MadeMap gibbs_map(const RefinementJob& job, const Progress& progress, const std::stop_token& stop) {
  OccupancyMap conventional(job.grid, job.model);
  for (const Scan& scan : job.scans) conventional.insert(scan, stop);
  const GibbsPosterior posterior = sample_posterior(
      job.grid, measurements_of(job.scans), job.sampler, probabilities(conventional.voxels()), {},
      [&](double fraction, std::string_view what, const SamplerDiagnostics&) {
        if (progress) progress(fraction, what);
      },
      stop);
  throw_if_stopped(stop);
  return {posterior.voxels(job.model), posterior.centre_voxels(job.model), posterior.diagnostics};
}

MadeMap map_of(const RefinementJob& job, const std::string& kind, const Progress& progress,
               const std::stop_token& stop) {
  if (kind == "gibbs") return gibbs_map(job, progress, stop);
  const auto baseline = std::ranges::find(baseline_maps, kind, &BaselineMapInfo::name);
  if (baseline == baseline_maps.end()) throw std::invalid_argument("there is no map '" + kind + "'");
  const std::vector<Voxel> voxels = BaselineMaps(job.grid, job.scans, job.model).make(baseline->map);
  return {voxels, voxels, std::nullopt};
}

void add_quality(const MapScores& s, RunResult& result) {
  result.add("log_loss_near_surface[nats]", 0, s.touch_band.log_loss);
  result.add("brier_near_surface", 0, s.touch_band.brier);
  result.add("calibration_error_near_surface", 0, s.touch_band.calibration_error);
  result.add("centre_log_loss_near_surface[nats]", 0, s.centre_band.log_loss);
  result.add("log_loss[nats]", 0, s.touch_visited.log_loss);
  result.add("d_kl[nats]", 0, s.touch_visited.divergence);
  result.add("d_kl_outside_band[%]", 0, 100.0 * s.touch_visited.divergence_outside_band);
  if (s.surface_recall) result.add("surface_recall[%]", 0, 100.0 * *s.surface_recall);
  for (const ReliabilityBin& bin : s.touch_band.reliability) {
    const double at = 0.1 * double(&bin - s.touch_band.reliability.data()) + 0.05;
    result.add("reliability_voxels", at, double(bin.voxels));
    if (bin.voxels == 0) continue;
    result.add("reliability_said", at, bin.mean_probability);
    result.add("reliability_true", at, bin.occupied_share);
  }
}

void add_shares(const OpeningScore& score, const std::string& of, double at, RunResult& result) {
  const auto add = [&](const char* measure, const std::optional<double>& share) {
    if (share) result.add(measure + of, at, 100.0 * *share);
  };
  add("rows_open", score.row_openness());
  add("opening_recall", score.recall());
  add("leaks", score.leaks());
}

/// All together, and by the width of slots and bores.
void add_openings(const MadeMap& map, const RefinementTruth& truth, RunResult& result) {
  OpeningScore all;
  std::map<double, OpeningScore> by_width;  // [mm]
  for (const Opening& opening : truth.openings) {
    const OpeningScore score = score_opening(opening, map.centre, truth.voxels, TruthConvention::centre, truth.visited);
    all += score;
    by_width[std::round(1e3 * opening.width)] += score;
  }
  add_shares(all, "[%]", 0.0, result);
  for (const auto& [width, score] : by_width) add_shares(score, "_by_width[%]", width, result);
}

void add_chain(const SamplerDiagnostics& d, RunResult& result) {
  result.add("rays", 0, double(d.measured_rays));
  result.add("merged_rays", 0, double(d.merged_rays));
  result.add("observed_voxels", 0, double(d.observed_voxels));
  result.add("incidences", 0, double(d.incidences));
  result.add("sweeps", 0, d.sweeps);
  result.add("stationary", 0, d.stationary ? 1.0 : 0.0);
  result.add("r_hat", 0, d.r_hat);
  result.add("trend", 0, d.trend);
  result.add("effective_samples", 0, d.effective_samples);
  result.add("disagreeing_voxels", 0, double(d.disagreeing_voxels));
  for (std::size_t i = 0; i < std::min(d.divergence.size(), sweeps_shown); ++i)
    result.add("d_kl_of_mean[nats]", double(i + 2), d.divergence[i]);
  if (d.log_posterior.empty()) return;
  const std::vector<double>& chain = d.log_posterior.front();
  for (std::size_t i = 0; i < std::min(chain.size(), sweeps_shown); ++i)
    result.add("log_posterior_below_last[nats]", double(i + 1), chain.back() - chain[i]);
  for (std::size_t i = 0; i < std::min(d.changed_voxels.front().size(), sweeps_shown); ++i)
    result.add("changed_voxels[%]", double(i + 1),
               100.0 * double(d.changed_voxels.front()[i]) / double(d.observed_voxels));
}

/// What a map is made of, and what it is compared with. Its models alone are the kind of map's; the views, which take
/// as long as a conventional map, are the same for all kinds.
const RefinementJob& job_of_run(const Configuration& configuration, SharedByRuns& shared, const Progress& progress,
                                const std::stop_token& stop) {
  CandidateViewsConfig around = configuration.views;
  around.layout = ViewLayout::fibonacci;
  around.count = configuration.termination.views;
  Configuration fitted = configuration;
  const ConfiguredObject object = shared.objects.load(fitted, stop);  // the views' distance follows from its size
  around.radius = fitted.views.radius;
  Configuration seen = fitted;
  seen.map.model = {};
  seen.gibbs = {};
  if (const std::string from = to_toml(seen); from != shared.views_from) {
    shared.views_from.clear();
    shared.views = RefinementJob();  // before the next are taken: there may be no room for both
    shared.views = refinement_job(fitted, object, candidate_views(around, view_target(fitted)), progress, stop);
    shared.views_from = from;
  }
  shared.views.model = fitted.map.model;
  shared.views.sampler = posterior_sampler_config(fitted);
  return shared.views;
}

}  // namespace

RunResult perform_map(const Configuration& configuration, const std::string& kind, SharedByRuns& shared,
                      RunSeconds& seconds, const Progress& progress, const std::stop_token& stop) {
  const RefinementJob& job = job_of_run(configuration, shared, part(progress, 0.0, 0.3), stop);
  const auto make = [&] {
    const Stopwatch watch(kind == "gibbs" ? seconds.stages.refine : seconds.stages.insert);
    return map_of(job, kind, part(progress, 0.3, 1.0), stop);
  };
  const MadeMap map = make();
  throw_if_stopped(stop);
  const Stopwatch watch(seconds.stages.evaluate);
  RunResult result;
  add_quality(score_map(map.voxels, map.centre, *job.truth), result);
  add_openings(map, *job.truth, result);
  if (map.diagnostics) add_chain(*map.diagnostics, result);
  return result;
}

}  // namespace nextview

#include "core/offline/refinement.hpp"

#include "core/gain/view_score.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/planner/rank_correlation.hpp"

namespace nextview {
namespace {

std::vector<double> gibbs_gains(const RefinementJob& job, const VoxelBricks& voxels) {
  const MapRays rays(job.grid, voxels, job.model.occupancy_threshold, job.ray_length);
  const Gain* gibbs = &gain("gibbs");
  std::vector<double> gains;
  for (const ViewScore& score : score_views(rays, job.candidates, job.bundle, {&gibbs, 1}))
    gains.push_back(score.gains.front());
  return gains;
}

}  // namespace

RefinementJob refinement_job(const RecordedScene& scene, const GibbsConfig& gibbs, std::uint64_t seed,
                             const std::function<void(const std::string&)>& warn) {
  const SceneParameters parameters = scene_parameters(scene, warn);
  if (scene.scans.empty()) throw std::invalid_argument("the scene holds no scan");
  RefinementJob job;
  job.grid = parameters.grid();
  job.model = parameters.map.model;
  job.ray_length = parameters.map.max_ray_depth;
  job.scans = scans_of(scene, parameters);
  job.candidates = scene.views;
  job.bundle = parameters.rays;
  const double resolution = parameters.map.resolution;
  job.sampler = posterior_sampler_config(gibbs, 0.25 * resolution, 0.001, resolution, seed);
  job.sampler.validate();
  return job;
}

Refinement refine(const RefinementJob& job, const Progress& progress, std::stop_token stop) {
  const auto report = [&](double fraction, std::string_view what) {
    if (progress) progress(fraction, what);
  };
  Refinement r{OccupancyMap(job.grid, job.model), {}, VoxelBricks(), {}, {}, 0.0, {}, {}};
  for (std::size_t k = 0; k < job.scans.size(); ++k) {
    report(0.2 * double(k) / double(job.scans.size()), "making the conventional map");
    r.conventional.insert(job.scans[k], stop);
  }
  r.posterior = sample_posterior(
      job.grid, measurements_of(job.scans), job.sampler, probabilities(r.conventional.voxels()), {},
      [&](double fraction, std::string_view what, const SamplerDiagnostics&) { report(0.2 + 0.7 * fraction, what); },
      stop);
  r.refined = r.posterior.bricks(job.model);
  report(0.9, "scoring the candidate views");
  r.gains_before = gibbs_gains(job, r.conventional.voxels());
  r.gains_after = gibbs_gains(job, r.refined);
  r.rank_correlation = rank_correlation(r.gains_before, r.gains_after);
  r.scores_before = score_map(r.conventional.voxels(), job.truth);
  r.scores_after = score_posterior(r.posterior, job.model, job.truth);
  return r;
}

MapScores score_map(std::span<const Voxel> touch, std::span<const Voxel> centre, const RefinementTruth& truth) {
  const auto quality = [&](std::span<const Voxel> voxels, TruthConvention convention, ScoredSet set) {
    return map_quality(probabilities(voxels), truth.voxels, convention, set, truth.visited);
  };
  MapScores scores{quality(touch, TruthConvention::touch, ScoredSet::visited_band),
                   quality(centre, TruthConvention::centre, ScoredSet::visited_band),
                   quality(touch, TruthConvention::touch, ScoredSet::visited),
                   quality(centre, TruthConvention::centre, ScoredSet::visited),
                   surface_recall(touch, truth.voxels, TruthConvention::touch, truth.visited),
                   {}};
  for (const Opening& opening : truth.openings)
    scores.openings += score_opening(opening, centre, truth.voxels, TruthConvention::centre, truth.visited);
  return scores;
}

std::optional<MapScores> score_map(const VoxelBricks& map, const std::optional<RefinementTruth>& truth) {
  if (!truth) return std::nullopt;
  const std::vector<Voxel> voxels = map.dense();
  return score_map(voxels, voxels, *truth);
}

std::optional<MapScores> score_posterior(const GibbsPosterior& posterior, const InverseSensorModel& classes,
                                         const std::optional<RefinementTruth>& truth) {
  if (!truth) return std::nullopt;
  return score_map(posterior.voxels(classes), posterior.centre_voxels(classes), *truth);
}

}  // namespace nextview

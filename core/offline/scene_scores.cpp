#include "core/offline/scene_scores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "core/offline/refinement.hpp"
#include "core/offline/scene_parameters.hpp"
#include "core/planner/policy.hpp"
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// What is known after all scans of the scene. Of the reference semantics there is their own map alone.
Knowledge scanned(const RecordedScene& scene, const SceneParameters& parameters, Semantics semantics,
                  const Progress& progress, const std::stop_token& stop) {
  const bool reference = semantics == Semantics::reference;
  Knowledge known{OccupancyMap(reference ? VoxelGrid{} : parameters.grid(), parameters.map.model)};
  if (reference) known.reference = std::make_shared<ReferenceMap>(parameters.map);
  const FusionConfig fusion{Insertion::direct, parameters.map.occlusion_distance};
  const std::vector<Scan> scans = scans_of(scene, parameters);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    if (progress) progress(double(k) / double(scans.size()), "making the map");
    fuse(known, scans[k], fusion, {}, stop);
  }
  return known;
}

/// The same with the Gibbs map of all scans, refined as `refine` does.
Knowledge with_posterior(Knowledge known, const RecordedScene& scene, const Progress& progress,
                         const std::stop_token& stop) {
  const RefinementJob job = refinement_job(scene, GibbsConfig{}, 1);
  auto posterior = std::make_shared<GibbsState>(job.grid, job.sampler, job.model);
  for (const Scan& scan : job.scans) posterior->add(scan);
  const auto report = [&](double fraction, std::string_view what, const SamplerDiagnostics&) {
    if (progress) progress(fraction, what);
  };
  posterior->refine(&known.map.voxels(), 0, report, stop);  // until it is stationary
  throw_if_stopped(stop);
  known.posterior = std::move(posterior);
  return known;
}

}  // namespace

SceneScores score_scene(const RecordedScene& scene, Semantics semantics, std::span<const std::string> names,
                        const std::function<void(const std::string&)>& warn, const Progress& progress,
                        std::stop_token stop) {
  if (scene.views.empty()) throw std::invalid_argument("the scene has no candidate views (`view` lines)");
  const SceneParameters parameters = scene_parameters(scene, warn);
  const Knowledge known = scanned(scene, parameters, semantics, part(progress, 0.0, 0.2), stop);
  const auto rays = planning_rays(known, parameters.map.max_ray_depth);
  const double reach = occlusion_reach(parameters.map.occlusion_distance, parameters.map.resolution);
  const std::vector<View> candidates = views_at(scene.views);
  // The gains of single views share one cast of the rays; the others follow, a column each.
  SceneScores scores;
  std::vector<const Gain*> gains;
  std::vector<PlannerConfig> others;
  for (const std::string& name : names) {
    PlannerConfig planner;
    planner.gain = name;
    planner.semantics = semantics;
    const auto policy = make_policy(planner);
    if (!policy->gain() || policy->needs().posterior) {
      others.push_back(planner);
    } else {
      gains.push_back(policy->gain());
      scores.gains.push_back(name);
    }
  }
  if (progress) progress(0.2, "scoring the candidate views");
  scores.views = score_views(*rays, scene.views, parameters.rays, gains, {semantics, reach}, stop);
  throw_if_stopped(stop);
  std::vector<std::size_t> all(scene.views.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::optional<Knowledge> refined;
  std::unique_ptr<RayCaster> refined_rays;
  for (const PlannerConfig& planner : others) {
    const auto policy = make_policy(planner);
    const bool on_posterior = policy->needs().posterior;
    if (on_posterior && semantics == Semantics::reference)
      throw std::invalid_argument(
          fmt::format("the gain {} has published semantics only: the reference code knows no Gibbs map", planner.gain));
    if (on_posterior && !refined) {
      refined = with_posterior(known, scene, part(progress, 0.3, 1.0), stop);
      refined_rays = planning_rays(*refined, parameters.map.max_ray_depth);
    }
    const PlanningState state{planner,
                              1,
                              reach,
                              on_posterior ? *refined : known,
                              on_posterior ? *refined_rays : *rays,
                              parameters.rays,
                              nullptr,
                              candidates,
                              {}};
    const auto column = policy->values(state, all, stop).gains;
    throw_if_stopped(stop);
    scores.gains.push_back(planner.gain);
    for (std::size_t v = 0; v < column.size(); ++v) scores.views[v].gains.push_back(column[v]);
  }
  return scores;
}

}  // namespace nextview

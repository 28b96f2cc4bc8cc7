#include "core/session/scene_scores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "core/map/occupancy_map.hpp"
#include "core/planner/policy.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/refinement.hpp"
#include "core/session/scene_parameters.hpp"

namespace nextview {
namespace {

/// A map of the scene and the rays through it.
struct SceneRays {
  std::unique_ptr<OccupancyMap> map;  ///< published
  std::unique_ptr<RayCaster> caster;
};

SceneRays build(const RecordedScene& scene, const SceneParameters& parameters, Semantics semantics,
                const Progress& progress, const std::stop_token& stop) {
  SceneRays rays;
  std::size_t inserted = 0;
  const auto tell = [&] {
    if (progress) progress(double(inserted++) / double(scene.scans.size()), "making the map");
  };
  const ReferenceMap::Parameters& p = parameters.map;
  if (semantics == Semantics::reference) {
    auto map = std::make_unique<ReferenceMap>(p);
    for (const RecordedScan& recorded : scene.scans) {
      tell();
      const Scan scan = to_scan(recorded);
      map->insert(scan.origin, scan.returns, stop);
    }
    rays.caster = std::move(map);
    return rays;
  }
  rays.map = std::make_unique<OccupancyMap>(parameters.grid(), p.model);
  for (const RecordedScan& recorded : scene.scans) {
    tell();
    const Scan scan = to_scan(recorded);
    rays.map->insert(scan, parameters.max_range(), stop);
    rays.map->mark_occlusions(scan, parameters.max_range(), p.occlusion_distance, stop);
  }
  rays.caster =
      std::make_unique<MapRays>(rays.map->grid(), rays.map->voxels(), p.model.occupancy_threshold, p.max_ray_depth);
  return rays;
}

/// The gains of the views on the Gibbs map of the scene.
std::vector<double> gibbs_gains(const RecordedScene& scene, const Progress& progress, const std::stop_token& stop) {
  const RefinementJob job = refinement_job(scene, GibbsConfig{}, 1);
  std::vector<double> gains = refine(job, progress, stop).gains_after;
  throw_if_stopped(stop);
  return gains;
}

}  // namespace

SceneScores score_scene(const RecordedScene& scene, Semantics semantics, std::span<const std::string> names,
                        const std::function<void(const std::string&)>& warn, const Progress& progress,
                        std::stop_token stop) {
  if (scene.views.empty()) throw std::invalid_argument("the scene has no candidate views (`view` lines)");
  const SceneParameters parameters = scene_parameters(scene, warn);
  const SceneRays built = build(scene, parameters, semantics, progress, stop);
  const double reach = 2.0 * parameters.map.occlusion_distance / parameters.map.resolution;
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
  if (progress) progress(0.0, "scoring the candidate views");
  scores.views = score_views(*built.caster, scene.views, parameters.rays, gains, {semantics, reach}, stop);
  throw_if_stopped(stop);
  std::vector<std::size_t> all(scene.views.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (const PlannerConfig& planner : others) {
    const auto policy = make_policy(planner);
    const bool on_posterior = policy->needs().posterior;
    if (on_posterior && semantics == Semantics::reference)
      throw std::invalid_argument(
          fmt::format("the gain {} has published semantics only: the reference code knows no Gibbs map", planner.gain));
    const PlanningState state{planner, 1, reach, *built.caster, parameters.rays, nullptr, scene.views, {}};
    const auto column = on_posterior ? gibbs_gains(scene, progress, stop) : policy->values(state, all, stop);
    throw_if_stopped(stop);
    scores.gains.push_back(planner.gain);
    for (std::size_t v = 0; v < column.size(); ++v) scores.views[v].gains.push_back(column[v]);
  }
  return scores;
}

}  // namespace nextview

#include "core/session/scene_scores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "core/map/occupancy_map.hpp"
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
  const auto wants = [&](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  SceneScores scores;
  std::vector<const Gain*> all;
  for (const std::string& name : names)
    if (name != "combined" && name != "gibbs") {
      all.push_back(&gain(name));
      scores.gains.push_back(name);
    }
  const std::size_t plain = all.size();
  std::vector<double> weights;
  if (wants("combined"))
    for (const WeightedGain& w : prerelease_weights()) {
      all.push_back(&gain(w.name));
      weights.push_back(w.weight);
    }
  const SceneRays built = build(scene, parameters, semantics, progress, stop);
  if (progress) progress(0.0, "scoring the candidate views");
  scores.views = score_views(*built.caster, scene.views, parameters.rays, all,
                             {semantics, 2.0 * parameters.map.occlusion_distance / parameters.map.resolution}, stop);
  throw_if_stopped(stop);
  std::vector<std::vector<double>> values(weights.size());
  for (std::size_t k = 0; k < weights.size(); ++k)
    for (const ViewScore& v : scores.views) values[k].push_back(v.gains[plain + k]);
  const auto add_column = [&](const char* name, const std::vector<double>& column) {
    scores.gains.emplace_back(name);
    for (std::size_t v = 0; v < column.size(); ++v) scores.views[v].gains.push_back(column[v]);
  };
  for (ViewScore& view : scores.views) view.gains.resize(plain);
  if (wants("gibbs")) {
    if (semantics == Semantics::reference)
      throw std::invalid_argument("the gain gibbs has published semantics only: the reference code knows no Gibbs map");
    add_column("gibbs", gibbs_gains(scene, progress, stop));
  }
  if (wants("combined")) add_column("combined", combine(weights, values, semantics));
  return scores;
}

}  // namespace nextview

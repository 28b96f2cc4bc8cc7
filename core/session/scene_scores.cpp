#include "core/session/scene_scores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "core/gain/map_rays.hpp"
#include "core/map/occupancy_map.hpp"

namespace nextview {
namespace {

/// The scene's parameters by the names of the reference code, with its defaults.
class Parameters {
 public:
  explicit Parameters(const std::map<std::string, double>& given) : given_(given) {}

  double operator()(const std::string& name, double otherwise) {
    known_.push_back(name);
    const auto found = given_.find(name);
    return found == given_.end() ? otherwise : found->second;
  }
  double positive(const std::string& name, double otherwise) {
    const double value = (*this)(name, otherwise);
    if (!(value > 0.0))
      throw std::invalid_argument(fmt::format("parameter {} must be greater than 0, not {}", name, value));
    return value;
  }
  std::vector<std::string> not_asked_for() const {
    std::vector<std::string> names;
    for (const auto& [name, value] : given_)
      if (std::find(known_.begin(), known_.end(), name) == known_.end()) names.push_back(name);
    return names;
  }

 private:
  const std::map<std::string, double>& given_;
  std::vector<std::string> known_;
};

/// OctoMap numbers voxels with 16 bits an axis, the origin in the middle.
void require_in_octree(const Vector3& point, double resolution, std::string_view what) {
  const double reach = 32768.0 * resolution;
  if ((point.array().abs() < reach).all()) return;
  throw std::invalid_argument(
      fmt::format("{} reaches beyond {} m, all that an octree of resolution {} m can hold", what, reach, resolution));
}

ReferenceMap::Parameters map_parameters(Parameters& p) {
  ReferenceMap::Parameters m;
  m.resolution = p.positive("resolution_m", m.resolution);
  if (m.resolution < 1e-4 || m.resolution > 1.0)
    throw std::invalid_argument(fmt::format("parameter resolution_m must be from 0.0001 to 1, not {}", m.resolution));
  m.model.hit = p("hit_probability", m.model.hit);
  m.model.miss = p("miss_probability", m.model.miss);
  m.model.clamp_min = p("clamping_threshold_min", m.model.clamp_min);
  m.model.clamp_max = p("clamping_threshold_max", m.model.clamp_max);
  m.model.occupancy_threshold = p("occupancy_threshold", m.model.occupancy_threshold);
  m.model.free_below = p("p_unknown_lower_bound", m.model.free_below);
  m.model.occupied_above = p("p_unknown_upper_bound", m.model.occupied_above);
  m.unknown_prior = p("p_unknown_prior", m.unknown_prior);
  m.use_bounding_box = p("use_bounding_box", 1.0) != 0.0;
  m.lower = {p("bbox_min_x_m", p("bbox_min_x", -0.64)), p("bbox_min_y_m", p("bbox_min_y", -0.64)),
             p("bbox_min_z_m", p("bbox_min_z", -0.64))};
  m.upper = {p("bbox_max_x_m", p("bbox_max_x", 0.64)), p("bbox_max_y_m", p("bbox_max_y", 0.64)),
             p("bbox_max_z_m", p("bbox_max_z", 0.64))};
  if ((m.lower.array() >= m.upper.array()).any())
    throw std::invalid_argument("the bounding box (bbox_min_*, bbox_max_*) is empty");
  if (m.use_bounding_box) {
    require_in_octree(m.lower, m.resolution, "the bounding box");
    require_in_octree(m.upper, m.resolution, "the bounding box");
  }
  m.max_sensor_range = p("max_sensor_range_m", m.max_sensor_range);
  m.occlusion_distance = p.positive("occlusion_update_dist_m", m.occlusion_distance);
  m.max_ray_depth = p.positive("max_ray_depth_m", m.max_ray_depth);
  return m;
}

RayBundle bundle(Parameters& p) {
  PinholeCamera camera;
  const auto pixels = [&](const char* name, double otherwise) {
    const double value = p.positive(name, otherwise);
    if (value > 20'000.0)
      throw std::invalid_argument(fmt::format("parameter {} must be at most 20000, not {}", name, value));
    return static_cast<int>(value);
  };
  camera.width = pixels("img_width_px", 752);
  camera.height = pixels("img_height_px", 480);
  camera.fx = p.positive("fx", 448.1);
  camera.fy = p.positive("fy", 448.1);
  camera.cx = p("cx", 376.5);
  camera.cy = p("cy", 240.5);
  const Eigen::Vector2d spacing(1.0 / p.positive("raycasting_resolution_x", 0.1),
                                1.0 / p.positive("raycasting_resolution_y", 0.1));
  const auto share = [&](const char* name, double otherwise) { return std::clamp(p(name, otherwise), 0.0, 1.0); };
  return RayBundle::reference(camera, {share("min_x_perc", 0.25), share("min_y_perc", 0.25)},
                              {share("max_x_perc", 0.75), share("max_y_perc", 0.75)}, spacing.cwiseMax(0.1));
}

Scan to_scan(const RecordedScan& recorded) {
  Scan scan;
  scan.origin = recorded.T_world_camera.translation();
  for (const Vector3& p : recorded.points) scan.returns.push_back((recorded.T_world_camera * p).cast<float>());
  return scan;
}

/// A map of the scene and the rays through it.
struct SceneRays {
  std::unique_ptr<OccupancyMap> map;  ///< published
  std::unique_ptr<RayCaster> caster;
};

SceneRays build(const RecordedScene& scene, const ReferenceMap::Parameters& p, Semantics semantics) {
  SceneRays rays;
  if (semantics == Semantics::reference) {
    auto map = std::make_unique<ReferenceMap>(p);
    for (const RecordedScan& recorded : scene.scans) {
      const Scan scan = to_scan(recorded);
      map->insert(scan.origin, scan.returns);
    }
    rays.caster = std::move(map);
    return rays;
  }
  VoxelGrid grid;
  grid.resolution = p.resolution;
  grid.first = (p.lower / p.resolution).array().floor().matrix().cast<int>();
  grid.size = (p.upper / p.resolution).array().ceil().matrix().cast<int>() - grid.first;
  if (grid.voxel_count() > (std::size_t{1} << 28))
    throw std::invalid_argument(
        fmt::format("the bounding box holds {} voxels; at most {} are held", grid.voxel_count(), 1 << 28));
  rays.map = std::make_unique<OccupancyMap>(grid, p.model);
  for (const RecordedScan& recorded : scene.scans) {
    const Scan scan = to_scan(recorded);
    rays.map->insert(scan, p.max_sensor_range < 0.0 ? 1e3 : p.max_sensor_range);
    rays.map->mark_occlusions(scan, p.max_sensor_range < 0.0 ? 1e3 : p.max_sensor_range, p.occlusion_distance);
  }
  rays.caster = std::make_unique<MapRays>(grid, rays.map->voxels(), p.model.occupancy_threshold, p.max_ray_depth);
  return rays;
}

}  // namespace

SceneScores score_scene(const RecordedScene& scene, Semantics semantics, std::span<const std::string> names,
                        const std::function<void(const std::string&)>& warn) {
  if (scene.views.empty()) throw std::invalid_argument("the scene has no candidate views (`view` lines)");
  Parameters parameters(scene.parameters);
  const ReferenceMap::Parameters p = map_parameters(parameters);
  p.model.validate();
  const RayBundle rays = bundle(parameters);
  parameters("voxels_in_void_ray", 100.0);  // the reference code has it, and never gets to use it
  for (const std::string& name : parameters.not_asked_for())
    if (warn) warn(fmt::format("parameter {} has no meaning here and is ignored", name));

  const bool combined = std::find(names.begin(), names.end(), "combined") != names.end();
  SceneScores scores;
  std::vector<const Gain*> wanted, parts;
  for (const std::string& name : names)
    if (name != "combined") {
      wanted.push_back(&gain(name));
      scores.gains.push_back(name);
    }
  std::vector<const Gain*> all = wanted;
  std::vector<double> weights;
  if (combined)
    for (const WeightedGain& w : prerelease_weights()) {
      all.push_back(&gain(w.name));
      weights.push_back(w.weight);
    }
  for (const RecordedScan& scan : scene.scans)
    require_in_octree(scan.T_world_camera.translation(), p.resolution, "the position of a scan");
  for (const Pose& view : scene.views) require_in_octree(view.translation(), p.resolution, "the position of a view");
  const SceneRays built = build(scene, p, semantics);
  scores.views =
      score_views(*built.caster, scene.views, rays, all, {semantics, 2.0 * p.occlusion_distance / p.resolution});
  if (!combined) return scores;

  std::vector<std::vector<double>> values(weights.size());
  for (std::size_t k = 0; k < weights.size(); ++k)
    for (const ViewScore& v : scores.views) values[k].push_back(v.gains[wanted.size() + k]);
  const auto sums = combine(weights, values, semantics);
  scores.gains.emplace_back("combined");
  for (std::size_t v = 0; v < scores.views.size(); ++v) {
    scores.views[v].gains.resize(wanted.size());
    scores.views[v].gains.push_back(sums[v]);
  }
  return scores;
}

}  // namespace nextview

#include "core/offline/scene_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "core/config/configuration.hpp"
#include "core/source/recorded_source.hpp"

namespace nextview {
namespace {

/// Settings that scenes know by other names.
constexpr std::array parameter_names = {std::pair{"map.resolution", "resolution_m"},
                                        std::pair{"map.hit", "hit_probability"},
                                        std::pair{"map.miss", "miss_probability"},
                                        std::pair{"map.clamp_min", "clamping_threshold_min"},
                                        std::pair{"map.clamp_max", "clamping_threshold_max"},
                                        std::pair{"map.occupancy_threshold", "occupancy_threshold"},
                                        std::pair{"map.free_below", "p_unknown_lower_bound"},
                                        std::pair{"map.occupied_above", "p_unknown_upper_bound"}};

/// What `check` finds wrong with settings, said of parameters.
void with_names_of_parameters(const std::function<void()>& check) {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    SettingSources names;
    for (const auto& [key, name] : parameter_names) names[key].name = fmt::format("parameter {}", name);
    throw std::invalid_argument(as_given(error.what(), names));
  }
}

/// The scene's parameters by the names of the reference code, with its defaults.
class Parameters {
 public:
  explicit Parameters(const std::map<std::string, double>& given) : given_(given) {}

  double operator()(const std::string& name, double otherwise) {
    known_.push_back(name);
    const auto found = given_.find(name);
    return found == given_.end() ? otherwise : found->second;
  }
  double positive(const std::string& name, double otherwise, double largest) {
    const double value = (*this)(name, otherwise);
    if (!(value > 0.0 && value <= largest))
      throw std::invalid_argument(
          fmt::format("parameter {} must be greater than 0 and at most {:g}, not {:g}", name, largest, value));
    return value;
  }
  const std::vector<std::string>& known() const { return known_; }
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
  constexpr double longest_ray = 1000.0;  // [m], as in configurations
  MapConfig map;
  map.resolution = m.resolution;
  map.model = m.model;
  auto map_settings = settings(map);
  for (const auto& [key, name] : parameter_names) {
    double& value = *std::get<double*>(find_setting(map_settings, key).value);
    value = p(name, value);
  }
  with_names_of_parameters([&] { find_setting(map_settings, "map.resolution").require_in_bounds(); });
  m.resolution = map.resolution;
  m.model = map.model;
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
  if (m.max_sensor_range > longest_ray)
    throw std::invalid_argument(
        fmt::format("parameter max_sensor_range_m must be at most {:g}, or negative for no limit, not {:g}",
                    longest_ray, m.max_sensor_range));
  m.occlusion_distance = p.positive("occlusion_update_dist_m", m.occlusion_distance, longest_ray);
  m.max_ray_depth = p.positive("max_ray_depth_m", m.max_ray_depth, longest_ray);
  return m;
}

RayBundle bundle(Parameters& p) {
  PinholeCamera camera;
  const auto pixels = [&](const char* name, double otherwise) {
    return static_cast<int>(p.positive(name, otherwise, 20'000.0));
  };
  constexpr double longest_focal_length = 1e6;  // [px]
  camera.width = pixels("img_width_px", 752);
  camera.height = pixels("img_height_px", 480);
  camera.fx = p.positive("fx", 448.1, longest_focal_length);
  camera.fy = p.positive("fy", 448.1, longest_focal_length);
  camera.cx = p("cx", 376.5);
  camera.cy = p("cy", 240.5);
  const Eigen::Vector2d spacing(1.0 / p.positive("raycasting_resolution_x", 0.1, 10.0),
                                1.0 / p.positive("raycasting_resolution_y", 0.1, 10.0));
  const auto share = [&](const char* name, double otherwise) { return std::clamp(p(name, otherwise), 0.0, 1.0); };
  const Eigen::Vector2d lowest(share("min_x_perc", 0.25), share("min_y_perc", 0.25));
  const Eigen::Vector2d highest(share("max_x_perc", 0.75), share("max_y_perc", 0.75));
  constexpr double max_rays = 4e6;  // as many as a configuration may have
  const Eigen::Array2d across =
      (highest - lowest).array().max(0.0) * Eigen::Array2d(camera.width, camera.height) / spacing.array() + 1.0;
  if (across.prod() > max_rays)
    throw std::invalid_argument(fmt::format(
        "a view has {:.3g} rays (img_width_px, img_height_px, raycasting_resolution_x, _y); at most {:g} are cast",
        across.prod(), max_rays));
  return RayBundle::reference(camera, lowest, highest, spacing);
}

}  // namespace

VoxelGrid SceneParameters::grid() const {
  require_in_octree(map.lower, map.resolution, "the bounding box");
  require_in_octree(map.upper, map.resolution, "the bounding box");
  VoxelGrid grid;
  grid.resolution = map.resolution;
  grid.first = (map.lower / map.resolution).array().floor().matrix().cast<int>();
  grid.size = (map.upper / map.resolution).array().ceil().matrix().cast<int>() - grid.first;
  if (grid.voxel_count() > (std::size_t{1} << 28))
    throw std::invalid_argument(fmt::format(
        "the bounding box holds {} voxels; at most {} are held: let them be larger (parameter resolution_m; "
        "of range scans --voxel), or the box smaller",
        grid.voxel_count(), 1 << 28));
  return grid;
}

SceneParameters scene_parameters(const RecordedScene& scene, const std::function<void(const std::string&)>& warn) {
  Parameters parameters(scene.parameters);
  SceneParameters result{map_parameters(parameters), bundle(parameters)};
  with_names_of_parameters([&] { result.map.model.validate(); });
  parameters("voxels_in_void_ray", 100.0);  // the reference code has it, and never gets to use it
  for (const std::string& name : parameters.not_asked_for())
    if (warn)
      warn(fmt::format("parameter {} has no meaning here and is ignored{}", name,
                       did_you_mean(name, parameters.known())));
  for (const RecordedScan& scan : scene.scans)
    require_in_octree(scan.T_world_camera.translation(), result.map.resolution, "the position of a scan");
  for (const Pose& view : scene.views)
    require_in_octree(view.translation(), result.map.resolution, "the position of a view");
  return result;
}

std::vector<Scan> scans_of(const RecordedScene& scene, const SceneParameters& parameters) {
  RecordedSource source(scene.scans, parameters.max_range());
  return take_scans(source, source.describe().frames, nullptr);
}

}  // namespace nextview

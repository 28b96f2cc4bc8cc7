#include "core/session/session_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/config/object_lengths.hpp"
#include "core/memory/available_memory.hpp"
#include "core/planner/adaptive_candidates.hpp"
#include "core/planner/policy.hpp"
#include "core/session/object_mesh.hpp"

namespace nextview {
namespace {

constexpr const char* coarser_map = "use coarser voxels (map.resolution) or a smaller region (map.region_edge)";
constexpr const char* fewer_pixels = "use fewer pixels (sensor.width, sensor.height) or views (termination.views)";

std::string map_text(const VoxelGrid& grid) {
  return fmt::format("a map of {} x {} x {} voxels", grid.size.x(), grid.size.y(), grid.size.z());
}

std::string text(const Vector3& p) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", p.x(), p.y(), p.z()); }

std::string image_text(const DepthCameraConfig& sensor) {
  return fmt::format("images of {} x {} pixels", sensor.width, sensor.height);
}

/// The map and what else has a value per voxel: the marks of a step or its local map, the bricks that it changes and
/// how far behind a surface they lie, truth, masks, and the sampler.
std::uint64_t map_bytes(const Configuration& c) {
  const VoxelGrid grid = configured_region(c);
  const std::uint64_t maps = c.map.insertion == Insertion::local_octree ? 2 : 1;
  const std::uint64_t truth = c.evaluation.enabled ? 1 : 0, changed = 7;
  const std::uint64_t sampler =
      make_policy(c.planner)->needs().posterior ? 88 + 25 * static_cast<std::uint64_t>(c.gibbs.sampler.chains) : 0;
  return maps * OccupancyMap::bytes(grid) + (truth + changed + sampler) * grid.voxel_count();
}

/// The most views that a scan can take: the start view, and each candidate.
int max_views(const Configuration& c) {
  return c.views.layout == ViewLayout::file ? c.termination.views : std::min(c.termination.views, c.views.count + 1);
}

/// The camera's rays, what a view makes of each while it is taken, and the clouds that stay.
std::uint64_t image_bytes(const Configuration& c) {
  constexpr std::uint64_t ray = 12, while_taken = 60, point = 12;
  const std::uint64_t pixels = std::uint64_t(c.sensor.width) * std::uint64_t(c.sensor.height);
  return pixels * (ray + while_taken + point * std::uint64_t(max_views(c)));
}

}  // namespace

Configuration affordable(Configuration c) try {
  const std::uint64_t map = map_bytes(c), images = image_bytes(c);
  if (map >= images) {
    require_memory(map, map_text(configured_region(c)), coarser_map);
    require_memory(map + images,
                   fmt::format("{}, with {} {},", map_text(configured_region(c)), max_views(c), image_text(c.sensor)),
                   coarser_map);
  } else {
    require_memory(map + images, fmt::format("a scan of {} {}", max_views(c), image_text(c.sensor)), fewer_pixels);
  }
  return c;
} catch (const OutOfMemory& error) {
  throw OutOfMemory(c.as_given(error.what()));
}

std::string not_enough_memory(const Configuration& c) {
  return c.as_given(fmt::format("out of memory with {} and {}, {:.1f} GB are left: {}", map_text(configured_region(c)),
                                image_text(c.sensor), double(available_memory()) / 1e9,
                                map_bytes(c) >= image_bytes(c) ? coarser_map : fewer_pixels));
}

Vector3 view_target(const Configuration& c) {
  return c.map.region.empty() ? Vector3::Zero().eval() : c.map.region_box().center().eval();
}

Pose configured_start_view(const Configuration& c) {
  if (!c.planner.start_view.empty()) return parse_view(c.planner.start_view);
  const double azimuth = c.planner.start_azimuth * std::numbers::pi / 180.0;
  const double elevation = c.planner.start_elevation * std::numbers::pi / 180.0;
  const Vector3 direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                          std::sin(elevation));
  return look_at(view_target(c) + c.views.radius * direction, view_target(c));
}

VoxelGrid configured_region(const Configuration& c) {
  if (!c.map.region.empty()) return region_of_interest(c.map.region_box(), c.map.resolution);
  return region_of_interest(Vector3::Zero(), c.map.region_edge, c.map.resolution);
}

View start_view(const Configuration& c, const SourceDescription& source, const Robot* robot) {
  if (!source.frames.empty()) return source.frames.front();
  if (source.start) return {*source.start};
  return {robot ? robot->pose() : configured_start_view(c)};
}

std::unique_ptr<Robot> configured_robot(const Configuration& c, const View& start) {
  auto camera = std::make_unique<FreeFlyingCamera>(start.T_world_camera);
  if (!c.recorded.folder.empty()) return camera;
  const auto volume = c.driver.volume();
  if (!outside(volume, start.T_world_camera.translation()).empty())
    throw std::invalid_argument(
        c.as_given("robot.working_volume: the start view lies outside of it; planner.start_view begins elsewhere"));
  camera->keep_within(volume);
  return camera;
}

VoxelGrid configured_region(const Configuration& c, const SourceDescription& source) {
  if (!source.region || !c.map.region.empty()) return configured_region(c);
  return region_of_interest(source.region->center(), source.region->sizes().maxCoeff(), c.map.resolution);
}

std::shared_ptr<const CandidateGenerator> configured_candidates(const Configuration& c, const SourceDescription& source,
                                                                const std::function<void(const std::string&)>& notice) {
  if (!source.frames.empty()) return std::make_shared<FixedCandidates>(source.frames);
  std::vector<View> views = views_at(candidate_views(c.views, view_target(c), notice));
  // What a planner is compared with knows no views but these.
  if (c.views.layout != ViewLayout::adaptive || policy_entry(c.planner.gain).baseline)
    return std::make_shared<FixedCandidates>(std::move(views));
  const RayBundle few = RayBundle::regular(source.camera, (c.planner.ray_columns + 1) / 2, (c.planner.ray_rows + 1) / 2,
                                           c.planner.ray_window);
  return std::make_shared<AdaptiveCandidates>(
      std::move(views), few,
      AdaptiveCandidatesConfig{c.views.adaptive, c.views.radius, c.sensor.min_range, c.planner.ray_length,
                               c.planner.new_surface, c.seed});
}

ProjectionPlacement projection_placement(const Configuration& c, const PlacedMesh& object) {
  const LengthUnit views = c.views.unit, own = object.unit == LengthUnit::automatic ? c.object.unit : object.unit;
  const MeshPlacement& placed = object.placement;
  if (views == LengthUnit::automatic) return {placed.centre, placed.scale, placed.up};
  if (own == LengthUnit::automatic && !c.views.file.empty())
    throw std::invalid_argument(
        "views.unit says what the projection matrices are in, but not what the object's file is in, which is scaled "
        "whatever that is; set object.unit too, or leave views.unit out");
  const double ratio = metres_per(views) / metres_per(own);  // of the object's units
  return {placed.centre / ratio, placed.scale * ratio, placed.up};
}

ObjectFile configured_object_file(const Configuration& c) {
  if (!c.driver.name.empty())
    throw std::invalid_argument(
        c.as_given(fmt::format("driver.name: this scan was taken by the scanner {}, which alone can repeat it: give "
                               "--driver, or --resume its folder",
                               c.driver.name)));
  const std::filesystem::path file = resolve_object(c);
  return {file, placement(c.object, file)};
}

void fit_to_object(Configuration& c, const ConfiguredObject& object) {
  const Eigen::AlignedBox3d box = object.placed->mesh.bounding_box();
  fit_lengths(c, box.sizes().maxCoeff());
  fit_region(c, box);
  c = affordable(validated(std::move(c)));
  c.views.projections = projection_placement(c, *object.placed);
  require_within_region(object.placed->mesh, c, object.file);
}

ConfiguredObject load_object(Configuration& c, const std::stop_token& stop) {
  const ObjectFile file = configured_object_file(c);
  ConfiguredObject object{file.file, std::make_shared<PlacedMesh>(load_object_mesh(file.file, file.options, stop))};
  fit_to_object(c, object);
  return object;
}

void require_within_region(const TriangleMesh& object, const Configuration& c, const std::filesystem::path& file) {
  const Eigen::AlignedBox3d box = object.bounding_box(), region = c.map.region_box();
  const double longest = box.sizes().maxCoeff();
  const bool is_cube = c.map.region.empty() || !is_given(c, "map.region");
  if (is_cube && longest > c.map.region_edge)
    throw std::invalid_argument(fmt::format(
        "{}: the object is {:.3g} m long, but the region of interest has an edge of {} m; scale the object with "
        "object.longest_side or enlarge map.region_edge",
        file.string(), longest, c.map.region_edge));
  const Vector3 slack = Vector3::Constant(1e-6);  // what scaling to single precision rounds [m]
  if (!Eigen::AlignedBox3d(region.min() - slack, region.max() + slack).contains(box))
    throw std::invalid_argument(fmt::format(
        "{}: the object reaches from {} to {} m, beyond the region of interest from {} to {} m; enlarge {}, "
        "scale the object with object.longest_side, or move it with object.centred",
        file.string(), text(box.min()), text(box.max()), text(region.min()), text(region.max()),
        is_cube ? "map.region_edge" : "map.region"));
}

SurfaceSamples evaluation_samples(const Configuration& c, const TriangleMesh& object) {
  if (c.evaluation.samples == EvaluationSamples::vertices) return vertex_samples(object);
  return sample_surface(object, c.evaluation.surface_samples, c.seed);
}

RayBundle scoring_rays(const Configuration& c, const PinholeCamera& camera) {
  if (c.planner.semantics == Semantics::reference)
    return RayBundle::reference(camera, {0.25, 0.25}, {0.75, 0.75}, {10.0, 10.0});
  return RayBundle::regular(camera, c.planner.ray_columns, c.planner.ray_rows, c.planner.ray_window);
}

RayBundle finer_rays(const Configuration& c, const PinholeCamera& camera) {
  const PlannerConfig& p = c.planner;
  const double pixels_a_ray =
      p.ray_window * std::min(double(camera.width) / p.ray_columns, double(camera.height) / p.ray_rows);
  const int times = std::min(p.ray_refinement, int(pixels_a_ray));
  if (times <= 1 || p.semantics == Semantics::reference) return {};
  return RayBundle::regular(camera, times * p.ray_columns, times * p.ray_rows, p.ray_window);
}

namespace {

std::shared_ptr<const ReferenceMap> empty_reference_map(const Configuration& c, const VoxelGrid& region) {
  ReferenceMap::Parameters p;
  p.resolution = c.map.resolution;
  p.model = c.map.model;
  p.lower = region.lower();
  p.upper = region.upper();
  p.max_sensor_range = c.sensor.max_range;
  p.max_ray_depth = c.planner.ray_length;
  return std::make_shared<ReferenceMap>(p);
}

}  // namespace

Knowledge nothing_known(const Configuration& c, const VoxelGrid& region, const PolicyNeeds& needs) {
  Knowledge known{OccupancyMap(region, c.map.model)};
  if (c.planner.semantics == Semantics::reference) known.reference = empty_reference_map(c, region);
  if (needs.posterior) known.posterior = std::make_shared<GibbsState>(region, posterior_sampler_config(c), c.map.model);
  return known;
}

double occlusion_distance(const Configuration& c) {
  return c.planner.semantics == Semantics::reference ? default_occlusion_distance : c.map.occlusion_distance;
}

double occlusion_reach(const Configuration& c) { return occlusion_reach(occlusion_distance(c), c.map.resolution); }

Configuration validated(Configuration c) {
  c.validate();
  return c;
}

}  // namespace nextview

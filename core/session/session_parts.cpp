#include "core/session/session_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/planner/policy.hpp"

namespace nextview {

Pose configured_start_view(const Configuration& c) {
  const double azimuth = c.planner.start_azimuth * std::numbers::pi / 180.0;
  const double elevation = c.planner.start_elevation * std::numbers::pi / 180.0;
  const Vector3 direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                          std::sin(elevation));
  return look_at(c.views.radius * direction, Vector3::Zero());
}

VoxelGrid configured_region(const Configuration& c) {
  return region_of_interest(Vector3::Zero(), c.map.region_edge, c.map.resolution);  // load_mesh centres the object
}

void require_within_region(const TriangleMesh& object, const Configuration& c, const std::filesystem::path& file) {
  const double longest = object.bounding_box().sizes().maxCoeff();
  if (longest > c.map.region_edge)
    throw std::invalid_argument(fmt::format(
        "{}: the object is {:.3g} m long, but the region of interest has an edge of {} m; scale the object with "
        "object.longest_side or enlarge map.region_edge",
        file.string(), longest, c.map.region_edge));
}

RayBundle scoring_rays(const Configuration& c, const PinholeCamera& camera) {
  if (c.planner.semantics == Semantics::reference)
    return RayBundle::reference(camera, {0.25, 0.25}, {0.75, 0.75}, {10.0, 10.0});
  return RayBundle::regular(camera, c.planner.ray_columns, c.planner.ray_rows);
}

std::unique_ptr<ReferenceMap> make_reference_map(const Configuration& c) {
  if (c.planner.semantics != Semantics::reference) return nullptr;
  ReferenceMap::Parameters p;
  p.resolution = c.map.resolution;
  p.model = c.map.model;
  p.lower = configured_region(c).lower();
  p.upper = configured_region(c).upper();
  p.max_sensor_range = c.sensor.max_range;
  p.max_ray_depth = c.planner.ray_length;
  return std::make_unique<ReferenceMap>(p);
}

std::unique_ptr<MapRefinement> make_refinement(const Configuration& c) {
  if (!make_policy(c.planner)->needs().posterior) return nullptr;
  return std::make_unique<MapRefinement>(configured_region(c), posterior_sampler_config(c), c.map.model,
                                         c.sensor.max_range);
}

MapRays configured_rays(const Configuration& c, const VoxelGrid& grid, std::span<const Voxel> voxels) {
  return MapRays(grid, voxels, c.map.model.occupancy_threshold, c.planner.ray_length);
}

double occlusion_reach(const Configuration& c) { return 2.0 * occlusion_distance / c.map.resolution; }

Configuration validated(Configuration c) {
  c.validate();
  return c;
}

}  // namespace nextview

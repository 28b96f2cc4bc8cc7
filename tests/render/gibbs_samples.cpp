#include "tests/render/gibbs_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/config/gibbs_config.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/map/traversal.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview::samples {
namespace {

constexpr double degree = std::numbers::pi / 180;

Eigen::Matrix3d plate_rotation() {
  return (Eigen::AngleAxisd(RefinedPlate::turn_z * degree, Vector3::UnitZ()) *
          Eigen::AngleAxisd(RefinedPlate::turn_y * degree, Vector3::UnitY()) *
          Eigen::AngleAxisd(RefinedPlate::turn_x * degree, Vector3::UnitX()))
      .toRotationMatrix();
}

Part turned_plate() {
  const std::filesystem::path objects = std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets/objects";
  const PlacedMesh placed_mesh = load_placed_mesh(objects / "slotted_plate.ply");
  Part part{"slotted_plate", placed_mesh.mesh, read_openings(objects / "slotted_plate.json")};
  const Eigen::Matrix3d R = plate_rotation();
  for (Eigen::Vector3f& vertex : part.mesh.vertices) vertex = (R * vertex.cast<double>()).cast<float>();
  for (Opening& opening : part.openings) {
    opening = placed(opening, placed_mesh.placement);
    opening.centre = R * opening.centre;
    opening.axis = R * opening.axis;
    opening.along = R * opening.along;
  }
  const auto shown = part.openings.begin() + RefinedPlate::shown_opening;
  std::rotate(part.openings.begin(), shown, shown + 1);
  return part;
}

/// Evenly around the plate's normal, all on one side.
std::vector<Pose> views() {
  std::vector<Pose> poses;
  for (int i = 0; i < RefinedPlate::views; ++i) {
    const double azimuth = 0.3 + 2 * std::numbers::pi * i / RefinedPlate::views;
    const double tilt = RefinedPlate::camera_tilt * degree;
    const Vector3 direction(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
    poses.push_back(look_at(plate_rotation() * (RefinedPlate::camera_distance * direction), Vector3::Zero()));
  }
  return poses;
}

void mark_visited(const VoxelGrid& grid, const Scan& scan, std::vector<std::uint8_t>& visited) {
  RangeMeasurements rays;
  rays.max_range = scan.max_range;
  rays.add(scan);
  for (const RangeMeasurement& ray : rays.rays)
    walk_ray(grid, scan.origin, rays.direction(ray), rays.range(ray), [&](int x, int y, int z) {
      visited[grid.index({x, y, z})] = 1;
      return true;
    });
}

/// `solid`: of each voxel, the probability that its centre is.
MapNumbers numbers_of(std::span<const Voxel> map, std::span<const float> solid, const Part& part,
                      const GroundTruth& truth, std::span<const std::uint8_t> visited) {
  MapNumbers numbers;
  for (const Opening& opening : part.openings)
    numbers.openings += score_opening(opening, map, truth, TruthConvention::touch);
  numbers.shown_opening = score_opening(part.openings.front(), map, truth, TruthConvention::touch);
  numbers.near_surface =
      map_quality(probabilities(map), truth, TruthConvention::touch, ScoredSet::visited_band, visited);
  numbers.centres = map_quality(solid, truth, TruthConvention::centre, ScoredSet::visited_band, visited);
  for (const Voxel& voxel : map) {
    numbers.entropy += voxel.entropy;
    numbers.measured += voxel.measured;
  }
  return numbers;
}

}  // namespace

RefinedPlate refined_plate(std::uint64_t seed) {
  RefinedPlate plate{turned_plate(),
                     region_of_interest(Vector3::Zero(), RefinedPlate::region_edge, RefinedPlate::resolution),
                     {},
                     {},
                     {},
                     {},
                     {}};
  DepthCameraConfig config;
  config.width = RefinedPlate::width;
  config.height = RefinedPlate::height;
  config.range_noise = RefinedPlate::range_noise;
  config.outliers = RefinedPlate::outliers;
  const DepthCamera camera(config);
  const MeshRayCaster scene(plate.part.mesh);

  OccupancyMap map(plate.grid, InverseSensorModel{});
  RangeMeasurements measurements;
  measurements.max_range = config.max_range;
  std::vector<std::uint8_t> visited(plate.grid.voxel_count(), 0);
  std::uint32_t view = 0;
  for (const Pose& pose : views()) {
    const Scan scan = back_project(camera.sense(scene, pose, seed, view++), pose, config.max_range);
    map.insert(scan);
    measurements.add(scan);
    mark_visited(plate.grid, back_project(camera.sense_ideal(scene, pose), pose, config.max_range), visited);
  }
  plate.conventional = map.voxels().dense();
  const PosteriorSamplerConfig sampler =
      posterior_sampler_config(GibbsConfig{}, config.range_noise, ray_pitch(config), RefinedPlate::resolution, seed);
  const std::vector<float> start_map = probabilities(plate.conventional);
  const GibbsPosterior posterior = sample_posterior(plate.grid, measurements, sampler, start_map);
  plate.gibbs = posterior.voxels(map.model());
  plate.diagnostics = posterior.diagnostics;

  const GroundTruth truth = ground_truth(plate.part.mesh, plate.grid);
  plate.conventional_numbers = numbers_of(plate.conventional, start_map, plate.part, truth, visited);
  plate.gibbs_numbers = numbers_of(plate.gibbs, posterior.upper, plate.part, truth, visited);
  return plate;
}

}  // namespace nextview::samples

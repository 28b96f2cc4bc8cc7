#include "tests/benchmarks/evidence_cases.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <map>

#include "core/evaluation/visited_voxels.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/mesh/parts.hpp"
#include "core/offline/training_parts.hpp"
#include "tests/benchmarks/simulated_views.hpp"

namespace nextview {
namespace {

constexpr std::uint64_t fitting_seed = 19;
constexpr std::string_view part_prefix = "part ", detailed_prefix = "detailed part ";

/// Turned about all three axes, and moved off the grid by a share of a voxel.
Eigen::Affine3d off_the_grid() {
  return Eigen::Translation3d(0.0031, -0.0047, 0.0023) * Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitX());
}

bool is_made_up(const std::string& object) {
  return object.starts_with(part_prefix) || object.starts_with(detailed_prefix);
}

TriangleMesh made_up(const std::string& object) {
  const auto number = [&](std::string_view prefix) { return std::uint32_t(std::stoul(object.substr(prefix.size()))); };
  return object.starts_with(part_prefix) ? training_part(number(part_prefix), fitting_seed)
                                         : detailed_training_part(number(detailed_prefix), fitting_seed);
}

PlacedMesh mesh_of(const std::string& object) {
  if (!is_made_up(object)) return load_placed_mesh(resolve_object(object), {0.5});
  static std::map<std::string, TriangleMesh> made;  // each is asked for by all cameras
  const auto [part, is_new] = made.try_emplace(object);
  if (is_new) part->second = made_up(object);
  PlacedMesh placed;
  placed.mesh = part->second;
  return placed;
}

std::vector<Opening> openings_of(const std::string& object, const MeshPlacement& placement, const Eigen::Affine3d& T) {
  std::vector<Opening> openings;
  if (is_made_up(object)) return openings;
  const auto file = resolve_object(object).replace_extension(".json");
  if (!std::filesystem::exists(file)) return openings;
  for (Opening opening : read_openings(file)) {
    opening = placed(opening, placement);
    opening.centre = T * opening.centre;
    opening.axis = T.linear() * opening.axis;
    opening.along = T.linear() * opening.along;
    openings.push_back(opening);
  }
  return openings;
}

}  // namespace

EvidenceCase evidence_case(const std::string& object, EvidencePose pose, const EvidenceSensor& sensor, int views) {
  EvidenceCase result{object, pose, sensor, views, region_of_interest(Vector3::Zero(), 1.28, sensor.resolution),
                      {},     {}};
  PlacedMesh placed = mesh_of(object);
  const Eigen::Affine3d T = pose == EvidencePose::turned ? off_the_grid() : Eigen::Affine3d::Identity();
  for (Eigen::Vector3f& v : placed.mesh.vertices) v = (T * v.cast<double>()).cast<float>();
  result.truth = {std::make_shared<TriangleMesh>(placed.mesh), ground_truth(placed.mesh, result.grid),
                  std::vector<std::uint8_t>(result.grid.voxel_count()), openings_of(object, placed.placement, T)};
  DepthCameraConfig camera;
  camera.width = sensor.width;
  camera.height = sensor.width * 3 / 4;
  camera.range_noise = sensor.noise;
  camera.outliers = sensor.outliers;
  camera.max_range = sensor.max_range;
  SimulatedViews simulated = simulate_views(placed.mesh, camera, views);
  BitMask visited(result.grid.voxel_count());
  for (const Scan& ideal : simulated.ideal) mark_visited(result.grid, ideal, visited);
  result.truth.visited = visited.bytes();
  result.scans = std::move(simulated.scans);
  return result;
}

std::vector<FittingPart> fitting_parts() {
  constexpr int count = 12;  // of each kind
  std::vector<FittingPart> parts;
  for (const std::string_view kind : {part_prefix, detailed_prefix})
    for (int i = 1; i <= count; ++i)
      parts.push_back({fmt::format("{}{}", kind, i), i % 2 ? EvidencePose::turned : EvidencePose::as_placed});
  return parts;
}

std::vector<std::string> held_out_objects() {
  static constexpr std::array objects = {
      "bunny",
      "gearbox",
      "slotted_plate",
      "slotted_housing",
      "/usr/share/opencascade/data/stl/motor.stl",
      "/usr/share/opencascade/data/stl/bearing.stl",
      "/usr/share/opencascade/data/stl/head.stl",
      "/usr/share/opencascade/data/stl/shape.stl",
      "/usr/share/glmark2/models/horse.3ds",
      "/usr/share/glmark2/models/cat.3ds",
  };
  std::vector<std::string> installed;
  for (const char* object : objects) {
    try {
      if (std::filesystem::exists(resolve_object(object))) installed.push_back(object);
    } catch (const std::runtime_error&) {
      continue;
    }
  }
  return installed;
}

}  // namespace nextview

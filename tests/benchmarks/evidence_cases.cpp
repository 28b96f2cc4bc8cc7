#include "tests/benchmarks/evidence_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
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
/// Kinds of made-up parts, and how many of each.
struct Kind {
  std::string_view prefix;
  int count;
};
constexpr Kind plain{"part ", 12}, detailed{"detailed part ", 12};
/// As meshes come from elsewhere: with a hole, through which cameras see the inside; of solids that run through each
/// other, so that by the even-odd rule what both fill is outside.
constexpr Kind torn{"torn part ", 4}, overlapping{"overlapping parts ", 4};
constexpr std::array kinds = {plain, detailed, torn, overlapping};

/// Turned about all three axes, and moved off the grid by a share of a voxel.
Eigen::Affine3d off_the_grid() {
  return Eigen::Translation3d(0.0031, -0.0047, 0.0023) * Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitX());
}

bool is_made_up(const std::string& object) {
  return std::ranges::any_of(kinds, [&](const Kind& kind) { return object.starts_with(kind.prefix); });
}

/// Without the triangles within reach of one of its vertices.
TriangleMesh with_hole(TriangleMesh mesh, std::uint32_t number) {
  const float reach = 0.06f * float(number);  // [m]
  const Eigen::Vector3f centre = mesh.vertices[std::size_t{number} * 7919 % mesh.vertices.size()];
  std::erase_if(mesh.triangles, [&](const auto& triangle) {
    return std::ranges::all_of(triangle, [&](auto v) { return (mesh.vertices[v] - centre).norm() < reach; });
  });
  return mesh;
}

/// Both in one mesh, the second smaller and beside the first one's middle.
TriangleMesh both(TriangleMesh mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3f& v : other.vertices)
    mesh.vertices.emplace_back(0.6f * v + Eigen::Vector3f(0.1f, 0.05f, 0));
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

TriangleMesh made_up(const std::string& object) {
  const auto number = static_cast<std::uint32_t>(std::stoul(object.substr(object.rfind(' '))));
  if (object.starts_with(detailed.prefix)) return detailed_training_part(number, fitting_seed);
  constexpr std::uint32_t others = 100;  // parts that no case is of by itself
  const TriangleMesh part = training_part(number + (object.starts_with(plain.prefix) ? 0 : others), fitting_seed);
  if (object.starts_with(torn.prefix)) return with_hole(part, number);
  return object.starts_with(overlapping.prefix) ? both(part, training_part(number + 2 * others, fitting_seed)) : part;
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

std::vector<std::uint8_t> scored_voxels(const EvidenceCase& c) {
  const GroundTruth& truth = c.truth.voxels;
  std::vector<std::uint8_t> mask(truth.touch.size());
  for (std::size_t v = 0; v < mask.size(); ++v)
    mask[v] = c.truth.visited[v] && truth.near_surface[v] && !truth.hidden(v);
  return mask;
}

std::vector<float> centres_inside(const EvidenceCase& c) {
  constexpr float nudge = 1e-5f;  // [m]
  std::vector<float> inside(c.grid.voxel_count());
  for (const float way : {-nudge, nudge}) {
    TriangleMesh moved = *c.truth.mesh;
    for (Eigen::Vector3f& vertex : moved.vertices) vertex.array() += way;
    const GroundTruth truth = ground_truth(moved, c.grid);
    for (std::size_t v = 0; v < inside.size(); ++v) inside[v] += 0.5f * float(truth.centre[v]);
  }
  return inside;
}

double leave_out_undecided_centres(EvidenceCase& c) {
  const std::vector<float> inside = centres_inside(c);
  const std::vector<std::uint8_t> scored = scored_voxels(c);
  double all = 0.0, undecided = 0.0;
  for (std::size_t v = 0; v < scored.size(); ++v) {
    if (!scored[v]) continue;
    ++all;
    if (inside[v] != 0.5f) continue;
    ++undecided;
    c.truth.visited[v] = 0;
  }
  return undecided / all;
}

std::vector<FittingPart> fitting_parts() {
  std::vector<FittingPart> parts;
  for (const Kind& kind : kinds)
    for (int i = 1; i <= kind.count; ++i)
      parts.push_back({fmt::format("{}{}", kind.prefix, i), i % 2 ? EvidencePose::turned : EvidencePose::as_placed});
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

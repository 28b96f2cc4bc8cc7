#include "core/planner/surface_edge_policy.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <map>

namespace nextview {
namespace {

/// Few: what a straight edge has, which is about half, with a margin.
constexpr double edge_share = 0.6;

/// Sparse points of one voxel.
struct Edge {
  Vector3 middle = Vector3::Zero();  ///< of them [m, world]
  int points = 0;
};

std::vector<Edge> edges_of(const Knowledge& known) {
  const VoxelGrid& grid = known.map.grid();
  std::map<std::uint32_t, Edge> edges;
  for (const Eigen::Vector3f& point : known.scanned->sparse_points(edge_share)) {
    const Eigen::Vector3i cell = grid.cell_at(point.cast<double>());
    if (!grid.contains(cell)) continue;
    Edge& edge = edges[grid.index(cell)];
    edge.middle += point.cast<double>();
    ++edge.points;
  }
  std::vector<Edge> all;
  all.reserve(edges.size());
  for (auto& [voxel, edge] : edges) all.push_back({edge.middle / edge.points, edge.points});
  return all;
}

/// Rays through what is known, as far as the bundle's image and rays reach.
class Sight {
 public:
  explicit Sight(const PlanningState& state)
      : state_(state), map_(state.known.map), image_(Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()) {
    for (const Vector3& d : state.bundle.directions) image_.extend(Eigen::Vector2d(d.hnormalized()));
  }

  bool sees(const Pose& T_world_camera, const Vector3& point, std::vector<RayVoxel>& visited) const {
    const Vector3 in_camera = T_world_camera.inverse() * point;
    const double range = in_camera.norm();
    if (in_camera.z() <= 0.0 || range > state_.config.ray_length) return false;
    if (!image_.contains(Eigen::Vector2d(in_camera.hnormalized()))) return false;
    const Vector3 origin = T_world_camera.translation(), direction = (point - origin) / range;
    state_.caster.cast(origin, direction, visited);
    if (visited.empty()) return true;
    const RayVoxel& last = visited.back();
    if (!last.measured || last.probability < map_.model().occupancy_threshold) return true;
    const double resolution = map_.grid().resolution;
    const Vector3 stop(last.lattice[0] + 0.5, last.lattice[1] + 0.5, last.lattice[2] + 0.5);
    // The surface that the point lies on may stop the ray before it.
    return (stop * resolution - origin).dot(direction) > range - 2.0 * resolution;
  }

 private:
  const PlanningState& state_;
  const OccupancyMap& map_;
  Eigen::AlignedBox2d image_;  ///< at depth 1
};

}  // namespace

Valuation SurfaceEdgePolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                                    std::stop_token stop) const {
  std::vector<double> values(available.size(), 0.0);
  if (!state.known.scanned) return values;
  const std::vector<Edge> edges = edges_of(state.known);
  const Sight sight(state);
  tbb::parallel_for(std::size_t{0}, available.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    std::vector<RayVoxel> visited;
    for (const Edge& edge : edges)
      if (sight.sees(state.candidates[available[i]].T_world_camera, edge.middle, visited)) values[i] += edge.points;
  });
  return values;
}

}  // namespace nextview

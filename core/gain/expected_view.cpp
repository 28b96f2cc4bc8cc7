#include "core/gain/expected_view.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>

namespace nextview {
namespace {

/// Where a ray enters a voxel [m along the ray], not before its origin; where it comes nearest to the voxel's centre if
/// rounding has it miss.
double entry(const RayVoxel& voxel, double resolution, const Vector3& origin, const Vector3& direction) {
  const Vector3 lower = Vector3(voxel.lattice[0], voxel.lattice[1], voxel.lattice[2]) * resolution;
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double a = (lower[axis] - origin[axis]) / direction[axis];
    const double b = (lower[axis] + resolution - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter <= leave) return enter;
  return std::max(0.0, (lower + Vector3::Constant(0.5 * resolution) - origin).dot(direction));
}

}  // namespace

ExpectedView expected_view(const RayCaster& caster, const Pose& T_world_camera, const PinholeCamera& camera,
                           int columns, int rows, double resolution, double occupancy_threshold) {
  if (columns < 1 || rows < 1) throw std::invalid_argument("expected view: columns and rows must be over 0");
  const std::vector<Vector3> directions = RayBundle::regular(camera, columns, rows).directions;
  ExpectedView view{columns, rows, std::vector<float>(directions.size(), -1.0f),
                    std::vector<std::uint8_t>(directions.size(), 0)};
  const Vector3 origin = T_world_camera.translation();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, directions.size(), 256), [&](const auto& range) {
    std::vector<RayVoxel> visited;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Vector3 along = T_world_camera.linear() * directions[i];
      caster.cast(origin, along, visited);
      view.unknown[i] = std::any_of(visited.begin(), visited.end(), [](const RayVoxel& v) { return !v.measured; });
      if (visited.empty() || !visited.back().measured || visited.back().probability < occupancy_threshold) continue;
      view.depth[i] = static_cast<float>(entry(visited.back(), resolution, origin, along) * directions[i].z());
    }
  });
  return view;
}

}  // namespace nextview

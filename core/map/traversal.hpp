#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/map/voxel_grid.hpp"

namespace nextview {

/// How long a ray is, in single precision as OctoMap has cameras and points [m].
inline double ray_length(const Eigen::Vector3f& origin, const Eigen::Vector3f& end) {
  const Eigen::Vector3f d = end - origin;
  return std::sqrt(static_cast<double>(d.x() * d.x() + d.y() * d.y() + d.z() * d.z()));
}

/// The point at `length` [m] on the way from origin to point, and beyond, with OctoMap's rounding.
inline Eigen::Vector3f point_on_ray(const Eigen::Vector3f& origin, const Eigen::Vector3f& point, double length) {
  Eigen::Vector3f direction = point - origin;
  const auto whole = static_cast<float>(ray_length(origin, point));
  for (float& d : direction) d /= whole;
  return origin + direction * static_cast<float>(length);
}

/// Steps from voxel to voxel along a straight line (Amanatides and Woo 1987).
struct VoxelWalk {
  int x, y, z;  ///< current voxel
  int step_x, step_y, step_z;
  double next_x, next_y, next_z;  ///< distance along the line at which the next face is met, per axis
  double delta_x, delta_y, delta_z;

  /// Goes to the next voxel. Which axis is next changes at random from step to step, so selecting beats branching.
  void advance() {
    const bool along_x = (next_x < next_y) & (next_x < next_z);
    const bool along_y = !(next_x < next_y) & (next_y < next_z);
    const bool along_z = !(along_x | along_y);
    x += along_x ? step_x : 0;
    y += along_y ? step_y : 0;
    z += along_z ? step_z : 0;
    next_x += along_x ? delta_x : 0.0;
    next_y += along_y ? delta_y : 0.0;
    next_z += along_z ? delta_z : 0.0;
  }
  /// Distance at which the current voxel is left.
  double exit() const { return std::min(std::min(next_x, next_y), next_z); }
};

/// One axis of a walk that starts at `position` in cell `cell`: its step, first face and spacing. Cells count from the
/// lattice's origin.
inline void set_axis(double position, double direction, int cell, double resolution, int& step, double& next,
                     double& delta) {
  if (direction == 0.0) {
    step = 0;
    next = delta = std::numeric_limits<double>::max();
    return;
  }
  step = direction > 0.0 ? 1 : -1;
  // OctoMap reaches the face from the voxel's centre, the half step in single precision; so does this, to round alike.
  const double face = (cell + 0.5) * resolution + static_cast<float>(step * resolution * 0.5);
  next = (face - position) / direction;
  delta = resolution / std::abs(direction);
}

/// Visits the voxels from the one of `origin` to the one before `end`'s, in order, with the rounding of OctoMap's
/// computeRayKeys, so that a dense map equals a tree. `visit(x, y, z)` gets grid coordinates, which may lie outside of
/// the grid; false ends the walk. A segment that is longer than single precision can tell has no direction and is not
/// walked.
template <class Visit>
void walk_segment(const VoxelGrid& grid, const Eigen::Vector3f& origin, const Eigen::Vector3f& end, Visit visit) {
  Eigen::Vector3f direction = end - origin;
  const float length = static_cast<float>(std::sqrt(static_cast<double>(
      direction.x() * direction.x() + direction.y() * direction.y() + direction.z() * direction.z())));
  if (!std::isfinite(length)) return;
  const Eigen::Vector3i from = grid.cell_at(origin.cast<double>());
  const Eigen::Vector3i to = grid.cell_at(end.cast<double>());
  if (from == to || !visit(from.x(), from.y(), from.z())) return;
  for (float& d : direction) d /= length;

  const Eigen::Vector3i lattice = from + grid.first;
  VoxelWalk w{from.x(), from.y(), from.z(), 0, 0, 0, 0, 0, 0, 0, 0, 0};
  set_axis(origin.x(), direction.x(), lattice.x(), grid.resolution, w.step_x, w.next_x, w.delta_x);
  set_axis(origin.y(), direction.y(), lattice.y(), grid.resolution, w.step_y, w.next_y, w.delta_y);
  set_axis(origin.z(), direction.z(), lattice.z(), grid.resolution, w.step_z, w.next_z, w.delta_z);
  while (true) {
    w.advance();
    const int at_end = int(w.x == to.x()) & int(w.y == to.y()) & int(w.z == to.z());
    // Rounding may carry the walk past the end's voxel; its length ends it then.
    if (at_end | int(w.exit() > length)) return;
    if (!visit(w.x, w.y, w.z)) return;
  }
}

/// The voxels inside the grid that walk_segment visits. The walk ends where the segment has left the grid or can no
/// longer enter it, however long it is.
template <class Visit>
void walk_segment_inside(const VoxelGrid& grid, const Eigen::Vector3f& origin, const Eigen::Vector3f& end,
                         Visit visit) {
  const Eigen::Vector3f direction = end - origin;
  const auto in_grid = [&](int x, int y, int z) {
    return unsigned(x) < unsigned(grid.size.x()) && unsigned(y) < unsigned(grid.size.y()) &&
           unsigned(z) < unsigned(grid.size.z());
  };
  const auto leaves = [](int at, int size, float towards) {
    return at < 0 ? !(towards > 0.0f) : at >= size && !(towards < 0.0f);
  };
  walk_segment(grid, origin, end, [&](int x, int y, int z) {
    if (in_grid(x, y, z)) return visit(x, y, z);
    return !leaves(x, grid.size.x(), direction.x()) && !leaves(y, grid.size.y(), direction.y()) &&
           !leaves(z, grid.size.z(), direction.z());
  });
}

/// Visits the voxels of the grid that the ray passes through between its origin and `max_range` [m], in order;
/// `direction` is of unit length. `visit(x, y, z, enter, exit)` gets grid coordinates inside the grid and the distances
/// from the origin [m] at which the ray enters and leaves the voxel (its whole chord, also where it holds the origin's
/// limit or `max_range`; never less than 0); false ends the walk.
template <class Visit>
void walk_ray_segments(const VoxelGrid& grid, const Vector3& origin, const Vector3& direction, double max_range,
                       Visit visit) {
  const Vector3 lower = grid.lower(), upper = grid.upper();
  double enter = 0.0, leave = max_range;
  int entry_axis = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (origin[axis] < lower[axis] || origin[axis] >= upper[axis]) return;
      continue;
    }
    const double to_lower = (lower[axis] - origin[axis]) / direction[axis];
    const double to_upper = (upper[axis] - origin[axis]) / direction[axis];
    if (std::min(to_lower, to_upper) > enter) {
      enter = std::min(to_lower, to_upper);
      entry_axis = axis;
    }
    leave = std::min(leave, std::max(to_lower, to_upper));
  }
  if (enter >= leave) return;

  Eigen::Vector3i cell =
      grid.cell_at(origin + enter * direction).cwiseMax(0).cwiseMin(grid.size - Eigen::Vector3i::Ones());
  if (entry_axis >= 0) cell[entry_axis] = direction[entry_axis] > 0.0 ? 0 : grid.size[entry_axis] - 1;
  const Eigen::Vector3i lattice = cell + grid.first;
  VoxelWalk w{cell.x(), cell.y(), cell.z(), 0, 0, 0, 0, 0, 0, 0, 0, 0};
  set_axis(origin.x(), direction.x(), lattice.x(), grid.resolution, w.step_x, w.next_x, w.delta_x);
  set_axis(origin.y(), direction.y(), lattice.y(), grid.resolution, w.step_y, w.next_y, w.delta_y);
  set_axis(origin.z(), direction.z(), lattice.z(), grid.resolution, w.step_z, w.next_z, w.delta_z);
  // The grid's far side is met by counting voxels, not by distance: no rounding cuts the last one short.
  const unsigned nx = grid.size.x(), ny = grid.size.y(), nz = grid.size.z();
  while (true) {
    // A ray that hardly moves along an axis may be a rounding beyond its face there, and meet it long ago.
    const double exit = std::max(w.exit(), enter);
    if (!visit(w.x, w.y, w.z, enter, exit) || exit >= max_range) return;
    enter = exit;
    w.advance();
    if (unsigned(w.x) >= nx || unsigned(w.y) >= ny || unsigned(w.z) >= nz) return;
  }
}

/// The same where distances do not matter: `visit(x, y, z)`.
template <class Visit>
void walk_ray(const VoxelGrid& grid, const Vector3& origin, const Vector3& direction, double max_range, Visit visit) {
  walk_ray_segments(grid, origin, direction, max_range,
                    [&](int x, int y, int z, double, double) { return visit(x, y, z); });
}

}  // namespace nextview

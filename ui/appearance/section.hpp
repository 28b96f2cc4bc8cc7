#pragma once
#include <Eigen/Core>

namespace nextview {

/// A plane across an axis, and the half of the world that is left of it.
struct Section {
  int axis = 2;              ///< 0 x, 1 y, 2 z
  double at = 0.0;           ///< [m, world]
  bool keeps_upper = false;  ///< what lies beyond the plane along the axis is left, not what lies before it

  bool holds(double place) const { return keeps_upper ? place >= at : place <= at; }
  bool holds(const Eigen::Vector3d& point) const { return holds(point[axis]); }
  /// Into what is left.
  Eigen::Vector3d inward() const { return Eigen::Vector3d::Unit(axis) * (keeps_upper ? 1.0 : -1.0); }
  Eigen::Vector3d origin() const { return Eigen::Vector3d::Unit(axis) * at; }
  bool operator==(const Section&) const = default;
};

}  // namespace nextview

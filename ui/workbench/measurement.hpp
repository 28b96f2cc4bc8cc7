#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/view/pose.hpp"

namespace nextview {

/// What is measured between points that the user picks.
enum class MeasureKind {
  distance,  ///< between two points
  plane,     ///< of a fourth point to the plane through three
  bore,      ///< the diameter through three points of a rim, fitted to what was measured around it
};

/// A circle in space, and how well points lie on it.
struct FittedCircle {
  Vector3 centre = Vector3::Zero(), normal = Vector3::UnitZ();  ///< [m, world], unit length
  double radius = 0.0;                                          ///< [m]
  double residual = 0.0;   ///< root mean square distance of the points to it, in its plane [m]
  std::size_t points = 0;  ///< that it was fitted to; 0: it goes through the three that were picked
};

/// Points that were picked so far, [m, world].
struct Measurement {
  MeasureKind kind = MeasureKind::distance;
  std::vector<Vector3> points;

  bool operator==(const Measurement&) const = default;
  /// How many points there are to be.
  std::size_t needed() const { return kind == MeasureKind::distance ? 2 : kind == MeasureKind::plane ? 4 : 3; }
  bool complete() const { return points.size() == needed(); }
};

/// The circle through three points; none if they lie on a line.
std::optional<FittedCircle> circle_through(const Vector3& a, const Vector3& b, const Vector3& c);
/// The same, fitted (least squares of distances in its plane) to the points of a cloud that lie near it: within a tenth
/// of its radius of the rim, and a quarter of it along the axis. As it was if fewer than twenty do.
FittedCircle fitted(const FittedCircle& circle, std::span<const Eigen::Vector3f> cloud);

/// "Distance 120.3 mm (dx 120, dy 0.5, dz -8.2 mm)". @pre measurement.complete()
std::string measured_text(const Measurement& measurement, std::span<const Eigen::Vector3f> cloud);
/// What to pick next: "Click the second point".
std::string measure_hint(const Measurement& measurement);

}  // namespace nextview

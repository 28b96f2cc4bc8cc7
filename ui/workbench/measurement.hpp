#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/workbench/fitted_circle.hpp"

namespace nextview {

/// What is measured between points that the user picks.
enum class MeasureKind {
  distance,  ///< between two points
  plane,     ///< of a fourth point to the plane through three
  bore,      ///< the diameter through three points of a rim, fitted to what was measured around it
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

/// The rim of a bore that is measured, fitted to what was measured around it; none of anything else, or where the
/// points lie on a line.
std::optional<FittedCircle> measured_circle(const Measurement& measurement, std::span<const Eigen::Vector3f> cloud);
/// "Distance 120.3 mm (dx 120, dy 0.5, dz -8.2 mm)"; of what is doubtful, that it is. @pre measurement.complete(),
/// `circle` is its measured_circle
std::string measured_text(const Measurement& measurement, const std::optional<FittedCircle>& circle);
/// What to pick next: "Click the second point".
std::string measure_hint(const Measurement& measurement);

}  // namespace nextview

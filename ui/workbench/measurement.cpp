#include "ui/workbench/measurement.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/setting/length_text.hpp"

namespace nextview {
namespace {

std::string precise(double length) {
  return std::abs(length) < 1.0 ? fmt::format("{:.4g} mm", 1e3 * length) : fmt::format("{:.5g} m", length);
}

}  // namespace

std::optional<FittedCircle> measured_circle(const Measurement& m, std::span<const Eigen::Vector3f> cloud) {
  if (m.kind != MeasureKind::bore || !m.complete()) return std::nullopt;
  const auto picked = circle_through(m.points[0], m.points[1], m.points[2]);
  return picked ? std::optional(fitted(*picked, cloud)) : std::nullopt;
}

std::string measured_text(const Measurement& m, const std::optional<FittedCircle>& circle) {
  if (m.kind == MeasureKind::distance) {
    const Vector3 by = m.points[1] - m.points[0];
    return fmt::format("Distance {} (dx {:.4g}, dy {:.4g}, dz {:.4g} mm)", precise(by.norm()), 1e3 * by.x(),
                       1e3 * by.y(), 1e3 * by.z());
  }
  const auto plane = circle_through(m.points[0], m.points[1], m.points[2]);
  if (!plane) return "The three points lie on a line";
  if (m.kind == MeasureKind::plane)
    return fmt::format("Distance to the plane {}", precise(std::abs(plane->normal.dot(m.points[3] - plane->centre))));
  if (circle->points == 0) return fmt::format("Diameter {} through the three points", precise(2 * circle->radius));
  if (circle->doubtful)
    return fmt::format("No clear rim there: a circle of {} has its {} points {} off", precise(2 * circle->radius),
                       circle->points, length_text(circle->residual));
  return fmt::format("Diameter {}, fitted to {} points with a residual of {}", precise(2 * circle->radius),
                     circle->points, length_text(circle->residual));
}

std::string measure_hint(const Measurement& m) {
  constexpr std::array ordinals = {"first", "second", "third", "fourth"};
  const char* const which = ordinals[m.complete() ? 0 : m.points.size()];
  switch (m.kind) {
    case MeasureKind::plane:
      return fmt::format("Distance to a plane: click the {} point{}{}", which,
                         m.points.size() == 3 ? ", off the plane" : " of the plane",
                         m.points.empty() ? "; M: a bore" : "");
    case MeasureKind::bore:
      return fmt::format("Diameter of a bore: click the {} point of its rim", which);
    case MeasureKind::distance:
      break;
  }
  return fmt::format("Distance: click the {} point{}", which, m.points.empty() ? "; M: to a plane, a bore" : "");
}

}  // namespace nextview

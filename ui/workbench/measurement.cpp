#include "ui/workbench/measurement.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "core/setting/length_text.hpp"

namespace nextview {
namespace {

constexpr std::size_t least_points = 20;               // that a fit says something by
constexpr double rim_reach = 0.10, axis_reach = 0.25;  // of a bore's points, as shares of its radius

std::string precise(double length) {
  return std::abs(length) < 1.0 ? fmt::format("{:.4g} mm", 1e3 * length) : fmt::format("{:.5g} m", length);
}

}  // namespace

std::optional<FittedCircle> circle_through(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 u = b - a, v = c - a, n = u.cross(v);
  const double scale = u.squaredNorm() + v.squaredNorm();
  if (!(n.norm() > 1e-6 * scale)) return std::nullopt;
  const Vector3 to_centre = (v.squaredNorm() * n.cross(u) + u.squaredNorm() * v.cross(n)) / (2.0 * n.squaredNorm());
  return FittedCircle{a + to_centre, n.normalized(), to_centre.norm()};
}

FittedCircle fitted(const FittedCircle& circle, std::span<const Eigen::Vector3f> cloud) {
  const Vector3 x = circle.normal.unitOrthogonal(), y = circle.normal.cross(x);
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector3f& p : cloud) {
    const Vector3 from = p.cast<double>() - circle.centre;
    const Eigen::Vector2d flat(from.dot(x), from.dot(y));
    if (std::abs(from.dot(circle.normal)) < axis_reach * circle.radius &&
        std::abs(flat.norm() - circle.radius) < rim_reach * circle.radius)
      points.push_back(flat);
  }
  if (points.size() < least_points) return circle;
  Vector3 fit(0.0, 0.0, circle.radius);  // centre and radius, by Gauss-Newton
  double squares = 0.0;
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vector3 right = Vector3::Zero();
    squares = 0.0;
    for (const Eigen::Vector2d& p : points) {
      const Eigen::Vector2d from = p - fit.head<2>();
      const double distance = from.norm();
      if (distance <= 0.0) continue;
      const Vector3 slope(-from.x() / distance, -from.y() / distance, -1.0);
      const double error = distance - fit.z();
      normal += slope * slope.transpose();
      right -= slope * error;
      squares += error * error;
    }
    const Vector3 by = normal.inverse() * right;
    if (!by.allFinite()) return circle;
    fit += by;
    if (by.norm() < 1e-9 * circle.radius) break;
  }
  return {circle.centre + fit.x() * x + fit.y() * y, circle.normal, fit.z(), std::sqrt(squares / double(points.size())),
          points.size()};
}

std::string measured_text(const Measurement& m, std::span<const Eigen::Vector3f> cloud) {
  if (m.kind == MeasureKind::distance) {
    const Vector3 by = m.points[1] - m.points[0];
    return fmt::format("Distance {} (dx {:.4g}, dy {:.4g}, dz {:.4g} mm)", precise(by.norm()), 1e3 * by.x(),
                       1e3 * by.y(), 1e3 * by.z());
  }
  const auto circle = circle_through(m.points[0], m.points[1], m.points[2]);
  if (!circle) return "The three points lie on a line";
  if (m.kind == MeasureKind::plane)
    return fmt::format("Distance to the plane {}", precise(std::abs(circle->normal.dot(m.points[3] - circle->centre))));
  const FittedCircle fit = fitted(*circle, cloud);
  if (fit.points == 0) return fmt::format("Diameter {} through the three points", precise(2 * fit.radius));
  return fmt::format("Diameter {}, fitted to {} points with a residual of {}", precise(2 * fit.radius), fit.points,
                     length_text(fit.residual));
}

std::string measure_hint(const Measurement& m) {
  constexpr std::array ordinals = {"first", "second", "third", "fourth"};
  const char* const which = ordinals[m.complete() ? 0 : m.points.size()];
  switch (m.kind) {
    case MeasureKind::plane:
      return fmt::format("Distance to a plane: click the {} point{}", which,
                         m.points.size() == 3 ? ", off the plane" : " of the plane");
    case MeasureKind::bore:
      return fmt::format("Diameter of a bore: click the {} point of its rim", which);
    case MeasureKind::distance:
      break;
  }
  return fmt::format("Distance: click the {} point", which);
}

}  // namespace nextview

#include "ui/workbench/fitted_circle.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bitset>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/cloud/evenly_kept.hpp"

namespace nextview {
namespace {

constexpr std::size_t least_points = 20, most_points = 8000;  // that a fit says something by; that it needs
// All in shares of the radius that was picked.
constexpr double nearby = 2.3;  // points that are looked at
constexpr double face_inside = 0.9, face_outside = 1.1, face_ends = 2.0;
constexpr double wall_begins = 0.3, wall_ends = 1.0;  // in depth
constexpr double far_off = 0.3, near_off = 0.05;      // points of the wall from the cylinder: first, and at least
constexpr double largest_residual = 0.08;             // of a wall; what is no cylinder has a tenth and more
constexpr double largest_sheet_residual = 0.045;      // points all over the band that is looked at have 0.058
constexpr double least_covered = 1.0 / 3.0;           // of its round

using Vector5 = Eigen::Matrix<double, 5, 1>;

/// A point as a circle sees it.
struct Beside {
  double along, across;     ///< the axis [m]
  Eigen::Vector2d outward;  ///< in the plane of `x` and `y`, of unit length
};
struct Frame {
  explicit Frame(const FittedCircle& c) : circle(c), x(c.normal.unitOrthogonal()), y(c.normal.cross(x)) {}
  Beside operator()(const Vector3& point) const {
    const Vector3 from = point - circle.centre;
    const Eigen::Vector2d flat(from.dot(x), from.dot(y));
    const double across = flat.norm();
    return {from.dot(circle.normal), across, flat / std::max(across, 1e-12)};
  }
  const FittedCircle& circle;
  Vector3 x, y;
};

std::vector<Vector3> points_near(const FittedCircle& circle, std::span<const Eigen::Vector3f> cloud) {
  std::vector<Vector3> near;
  for (const Eigen::Vector3f& p : cloud)
    if ((p.cast<double>() - circle.centre).norm() < nearby * circle.radius) near.push_back(p.cast<double>());
  return evenly_kept(near, most_points);
}

/// On which side of the rim the face is that it lies in: without for a bore, within for a pin.
bool face_is_outside(const FittedCircle& circle, const std::vector<Vector3>& points) {
  const Frame frame(circle);
  std::ptrdiff_t balance = 0;
  for (const Vector3& point : points) {
    const Beside p = frame(point);
    if (std::abs(p.along) < 0.25 * circle.radius) balance += p.across > circle.radius ? 1 : -3;  // three times as large
  }
  return balance >= 0;
}

/// Whether the face ends at the rim: on one side of it there are few points, for its area.
bool ends_at_rim(const FittedCircle& circle, const std::vector<Vector3>& points) {
  constexpr double inner = 0.8, outer_begins = 1.2, outer_ends = 1.8, thick = 0.15, few = 0.4;
  const Frame frame(circle);
  double within = 0.0, without = 0.0;
  for (const Vector3& point : points) {
    const Beside p = frame(point);
    const double across = p.across / circle.radius;
    if (std::abs(p.along) > thick * circle.radius) continue;
    within += across < inner;
    without += across > outer_begins && across < outer_ends;
  }
  within /= inner * inner;
  without /= outer_ends * outer_ends - outer_begins * outer_begins;
  return std::min(within, without) <= few * std::max(within, without);
}

/// The circle in the plane of the face; as it was where none is.
FittedCircle laid_on_face(const FittedCircle& picked, const std::vector<Vector3>& points) {
  const bool outside = face_is_outside(picked, points);
  const double from = outside ? face_outside * picked.radius : 0.0;
  const double to = (outside ? face_ends : face_inside) * picked.radius;
  FittedCircle circle = picked;
  double reach = 0.5 * picked.radius;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Frame frame(circle);
    std::vector<Vector3> face;
    Vector3 mean = Vector3::Zero();
    for (const Vector3& point : points) {
      const Beside p = frame(point);
      if (std::abs(p.along) < reach && p.across > from && p.across < to) face.push_back(point), mean += point;
    }
    if (face.size() < least_points) return picked;
    mean /= double(face.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vector3& point : face) covariance += (point - mean) * (point - mean).transpose() / double(face.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    Vector3 normal = solver.eigenvectors().col(0);
    if (normal.dot(circle.normal) < 0.0) normal = -normal;
    if (normal.dot(picked.normal) < 0.7) return picked;
    circle.centre += (mean - circle.centre).dot(normal) * normal;
    circle.normal = normal;
    if (iteration > 3) reach = std::max(0.1 * picked.radius, 3.0 * std::sqrt(std::max(0.0, solver.eigenvalues()[0])));
  }
  return circle;
}

double median_size(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Whether a point is of the wall on one side of the face, and no farther from the cylinder than `reach`.
bool is_of_wall(const Beside& p, double radius, double picked_radius, double side, double reach) {
  const double depth = side * p.along / picked_radius;
  return depth >= wall_begins && depth <= wall_ends && std::abs(p.across - radius) < reach;
}

/// Beside which share of the round there are points of the wall.
double covered_share(const FittedCircle& rim, const std::vector<Vector3>& points, double picked_radius, double side,
                     double reach) {
  std::bitset<36> sectors;
  const Frame frame(rim);
  for (const Vector3& point : points) {
    const Beside p = frame(point);
    if (!is_of_wall(p, rim.radius, picked_radius, side, reach)) continue;
    const double turn = 0.5 + std::atan2(p.outward.y(), p.outward.x()) / (2.0 * std::numbers::pi);
    sectors.set(std::min(std::size_t(turn * double(sectors.size())), sectors.size() - 1));
  }
  return double(sectors.count()) / double(sectors.size());
}

/// The rim of the cylinder through the points on one side of the face (1 or -1): centre, axis and radius by
/// Gauss-Newton, with Tukey's weights. Its residual is that of the points near it.
std::optional<FittedCircle> rim_of_wall(const FittedCircle& start, const std::vector<Vector3>& points, double side) {
  FittedCircle rim = start;
  double reach = far_off * start.radius;
  for (int iteration = 0; iteration < 40; ++iteration) {
    const Frame frame(rim);
    Eigen::Matrix<double, 5, 5> normal_matrix = Eigen::Matrix<double, 5, 5>::Zero();
    Vector5 pull = Vector5::Zero();
    std::vector<double> errors;
    for (const Vector3& point : points) {
      const Beside p = frame(point);
      if (!is_of_wall(p, rim.radius, start.radius, side, reach)) continue;
      const double error = p.across - rim.radius;
      const double weight = std::pow(1.0 - error * error / (reach * reach), 2);
      Vector5 slope;
      slope << p.outward, p.along * p.outward, 1.0;
      normal_matrix += weight * slope * slope.transpose();
      pull += weight * error * slope;
      errors.push_back(error);
    }
    if (errors.size() < least_points) return std::nullopt;
    const Vector5 by = normal_matrix.ldlt().solve(pull);
    if (!by.allFinite()) return std::nullopt;
    rim.centre += by[0] * frame.x + by[1] * frame.y;
    rim.normal = (rim.normal + by[2] * frame.x + by[3] * frame.y).normalized();
    rim.radius += by[4];
    if (!(rim.radius > 0.5 * start.radius && rim.radius < 2.0 * start.radius)) return std::nullopt;
    const double spread = 1.4826 * median_size(errors);  // a standard deviation, whatever else is there
    if (iteration >= 8) reach = std::max(near_off * start.radius, 3.0 * spread);
    double squares = 0.0;
    for (const double error : errors) squares += error * error;
    rim.points = errors.size();
    rim.residual = std::sqrt(squares / double(rim.points));
  }
  rim.doubtful = rim.residual > largest_residual * rim.radius ||
                 covered_share(rim, points, start.radius, side, reach) < least_covered;
  return rim;
}

/// As wide as what lies within a tenth of the rim and a quarter of the radius along its axis.
FittedCircle rim_of_sheet(const FittedCircle& start, const std::vector<Vector3>& points) {
  FittedCircle rim = start;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Frame before(start), frame(rim);
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    Vector3 pull = Vector3::Zero();
    double squares = 0.0;
    std::size_t count = 0;
    for (const Vector3& point : points) {
      const Beside was = before(point), p = frame(point);
      if (std::abs(was.along) > 0.25 * start.radius || std::abs(was.across - start.radius) > 0.1 * start.radius)
        continue;
      const Vector3 slope(p.outward.x(), p.outward.y(), 1.0);
      const double error = p.across - rim.radius;
      normal_matrix += slope * slope.transpose();
      pull += error * slope;
      squares += error * error;
      ++count;
    }
    if (count < least_points) return start;
    const Vector3 by = normal_matrix.ldlt().solve(pull);
    if (!by.allFinite()) return start;
    rim.centre += by.x() * frame.x + by.y() * frame.y;
    rim.radius += by.z();
    rim.points = count;
    rim.residual = std::sqrt(squares / double(count));
  }
  rim.doubtful = rim.residual > largest_sheet_residual * rim.radius;
  return rim;
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
  const std::vector<Vector3> points = points_near(circle, cloud);
  const FittedCircle on_face = laid_on_face(circle, points);
  const auto above = rim_of_wall(on_face, points, 1.0), below = rim_of_wall(on_face, points, -1.0);
  FittedCircle rim = circle;
  if (above && below)
    rim = above->residual < below->residual ? *above : *below;
  else if (above || below)
    rim = above ? *above : *below;
  else if (const FittedCircle sheet = rim_of_sheet(on_face, points); sheet.points > 0)
    rim = sheet;
  rim.doubtful |= rim.points > 0 && !ends_at_rim(on_face, points);
  return rim;
}

}  // namespace nextview

#include "ui/scene/camera_framing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace nextview {
namespace {

/// One axis of the image: where the camera must stand on it, and how far back at least, so that all points fall between
/// the image coordinates `low` and `high` (tangents). Each bound says `position <= p - bound * (z - depth)` or the
/// opposite for every point; the nearest camera meets one point on either side.
struct AxisFit {
  double depth;  ///< largest allowed camera depth (z of the camera centre)
  double low, high, upper, lower;

  AxisFit(std::span<const Vector3> points, int axis, double low_bound, double high_bound)
      : low(low_bound), high(high_bound) {
    upper = std::numeric_limits<double>::infinity();
    lower = -upper;
    for (const Vector3& p : points) {
      upper = std::min(upper, p[axis] - low * p.z());
      lower = std::max(lower, p[axis] - high * p.z());
    }
    depth = (upper - lower) / (high - low);
  }

  /// In the middle of what is allowed at a depth.
  double position(double at_depth) const { return 0.5 * (upper + low * at_depth + lower + high * at_depth); }
};

/// Spread evenly over the sphere.
Eigen::Vector3f direction(int i, int count) {
  const double z = 1 - (2 * i + 1.0) / count, around = i * std::numbers::pi * (3 - std::sqrt(5.0));
  const double radius = std::sqrt(1 - z * z);
  return Vector3(radius * std::cos(around), radius * std::sin(around), z).cast<float>();
}

}  // namespace

std::vector<Vector3> extreme_points(std::span<const Eigen::Vector3f> points) {
  constexpr int directions = 256;
  constexpr std::size_t looked_at = 200'000;
  const std::size_t stride = points.size() / looked_at + 1;
  std::vector<Vector3> result;
  for (int i = 0; i < directions && !points.empty(); ++i) {
    const Eigen::Vector3f outward = direction(i, directions);
    std::size_t farthest = 0;
    float most = outward.dot(points[0]);
    for (std::size_t p = stride; p < points.size(); p += stride) {
      const float reach = outward.dot(points[p]);
      if (!(reach > most)) continue;
      most = reach;
      farthest = p;
    }
    result.push_back(points[farthest].cast<double>());
  }
  return result;
}

Vector3 frame_points(const Eigen::Matrix3d& R_world_camera, double vertical_angle, double aspect,
                     const FrameMargins& margins, std::span<const Vector3> points) {
  if (points.empty()) throw std::invalid_argument("framing: there is nothing to look at");
  const double vertical = std::tan(vertical_angle / 2), horizontal = vertical * aspect;
  const double width = 1 - margins.left - margins.right, height = 1 - margins.bottom - margins.top;
  if (width <= 0 || height <= 0) throw std::invalid_argument("framing: the margins leave no room");
  std::vector<Vector3> in_camera;
  for (const Vector3& p : points) in_camera.emplace_back(R_world_camera.transpose() * p);
  const AxisFit x(in_camera, 0, horizontal * (2 * margins.left - 1), horizontal * (1 - 2 * margins.right));
  const AxisFit y(in_camera, 1, vertical * (2 * margins.top - 1), vertical * (1 - 2 * margins.bottom));
  double depth = std::min(x.depth, y.depth);
  for (const Vector3& p : in_camera) depth = std::min(depth, p.z() - 1e-3);
  return R_world_camera * Vector3(x.position(depth), y.position(depth), depth);
}

bool clears_corner(const Eigen::Matrix3d& R_world_camera, const Vector3& position, double vertical_angle, double aspect,
                   const Eigen::Vector2d& corner, std::span<const Vector3> points, bool lower_left) {
  const double outwards = lower_left ? -1 : 1;
  const double vertical = std::tan(vertical_angle / 2);
  std::vector<Eigen::Vector2d> from_corner;
  for (const Vector3& point : points) {
    const Vector3 p = R_world_camera.transpose() * (point - position);
    from_corner.emplace_back(outwards * (0.5 + 0.5 * p.x() / (p.z() * vertical * aspect) - corner.x()),
                             outwards * (0.5 - 0.5 * p.y() / (p.z() * vertical) - corner.y()));
  }
  // Clear if a straight line through the corner has all points on its far side.
  constexpr int directions = 16;
  for (int i = 0; i <= directions; ++i) {
    const double angle = i * std::numbers::pi / 2 / directions;
    const Eigen::Vector2d outward(std::cos(angle), std::sin(angle));
    const auto beyond = [&](const Eigen::Vector2d& p) { return outward.dot(p) > 0; };
    if (std::none_of(from_corner.begin(), from_corner.end(), beyond)) return true;
  }
  return false;
}

}  // namespace nextview

#include "core/cloud/object_box.hpp"

#include <algorithm>

namespace nextview {
namespace {

constexpr double deepest = 1.5;  // that an object is expected to be [its width]

double extent(const PointCloud& points, const Vector3& direction) {
  const auto along = [&](const Eigen::Vector3f& p) { return direction.dot(p.cast<double>()); };
  const auto [least, most] = std::ranges::minmax_element(points, {}, along);
  return along(*most) - along(*least);
}

/// Level, across the way away from the cameras.
Vector3 sideways(const Vector3& away) {
  const Vector3 level = away.cross(Vector3::UnitZ());
  return level.norm() > 0.1 ? Vector3(level.normalized()) : away.unitOrthogonal();
}

}  // namespace

Eigen::AlignedBox3d object_box(const PointCloud& points, const Vector3& towards_cameras,
                               std::span<const Vector3> planes_normals) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& p : points) box.extend(p.cast<double>());
  const double one_sided = towards_cameras.norm();  // 1 for a single view, 0 where it was seen from all around
  Vector3 away = -towards_cameras;
  for (const Vector3& normal : planes_normals) away -= std::min(0.0, away.dot(normal)) * normal;
  if (points.empty() || away.norm() < 0.1) return box;
  away.normalize();
  const double lacks = std::max(0.0, deepest * extent(points, sideways(away)) - extent(points, away));
  Eigen::AlignedBox3d behind = box;
  behind.translate(one_sided * lacks * away);
  return box.merged(behind);
}

}  // namespace nextview

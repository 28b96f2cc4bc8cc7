#include "ui/workbench/view_sight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/setting/length_text.hpp"

namespace nextview {
namespace {

/// Of the points of the object's surface that face a camera, those that it could measure if nothing else were in front
/// of them.
struct Sight {
  std::size_t in_picture = 0, measurable = 0;
  double nearest = 1e30;  ///< of those in the picture [m]
};

/// Some points of the surface as it is known: of the object, or what was measured of it.
SurfacePoints surface_of(const SessionSnapshot& s) {
  if (s.surface_points) return *s.surface_points;
  SurfacePoints measured;
  if (!s.cloud) return measured;
  constexpr std::size_t enough = 2000;
  const auto& points = s.cloud->points;
  for (std::size_t i = 0; i < points.size(); i += points.size() / enough + 1) measured.points.push_back(points[i]);
  return measured;
}

Eigen::AlignedBox3d box_of(const SurfacePoints& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& point : surface.points) box.extend(point.cast<double>());
  return box;
}

Sight sight_of(const SessionSnapshot& s, const SurfacePoints& surface, const Pose& T_world_camera) {
  const Pose T_camera_world = T_world_camera.inverse();
  const DepthCameraConfig& sensor = s.configuration.sensor;
  const Eigen::Vector3f camera = T_world_camera.translation().cast<float>();
  const auto& [points, outward] = surface;
  Sight sight;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 p = T_camera_world * points[i].cast<double>();
    if (p.z() <= 0 || (!outward.empty() && outward[i].dot(camera - points[i]) <= 0.0f)) continue;
    const Eigen::Vector2d pixel = s.camera.project(p);
    if (pixel.x() < -0.5 || pixel.y() < -0.5 || pixel.x() > s.camera.width - 0.5 || pixel.y() > s.camera.height - 0.5)
      continue;
    ++sight.in_picture;
    sight.nearest = std::min(sight.nearest, p.norm());
    sight.measurable += p.norm() >= sensor.min_range && p.norm() <= sensor.max_range;
  }
  return sight;
}

/// By the solid angle that the surface takes: a whole sphere's from within, nothing from outside. Turned triangles
/// count the other way round, so of a mesh that has many this may say no.
bool is_within(const TriangleMesh& mesh, const Vector3& point) {
  double angle = 0;
  for (const auto& t : mesh.triangles) {
    const std::array<Vector3, 3> v{mesh.vertices[t[0]].cast<double>() - point,
                                   mesh.vertices[t[1]].cast<double>() - point,
                                   mesh.vertices[t[2]].cast<double>() - point};
    const double a = v[0].norm(), b = v[1].norm(), c = v[2].norm();
    angle += 2 * std::atan2(v[0].dot(v[1].cross(v[2])),
                            a * b * c + v[0].dot(v[1]) * c + v[1].dot(v[2]) * a + v[2].dot(v[0]) * b);
  }
  return std::abs(angle) > 6.2831853;  // half of a whole sphere's
}

}  // namespace

std::string why_empty(const SessionSnapshot& s, const Pose& T_world_camera) {
  const SurfacePoints surface = surface_of(s);
  if (surface.points.empty()) return "";
  const Vector3 camera = T_world_camera.translation();
  if (s.mesh && s.object_box.contains(camera) && is_within(*s.mesh, camera)) return "the camera is inside the object";
  const Sight sight = sight_of(s, surface, T_world_camera);
  if (sight.measurable > 0) return "";
  const DepthCameraConfig& sensor = s.configuration.sensor;
  if (sight.in_picture == 0) return "it looks past the object";
  if (sight.nearest > sensor.max_range)
    return fmt::format("the object is {} away, and the sensor reaches {}", length_text(sight.nearest),
                       length_text(sensor.max_range));
  return fmt::format("the object is {} away, and the sensor needs {}", length_text(sight.nearest),
                     length_text(sensor.min_range));
}

PlacedView within_sight(const SessionSnapshot& s, const Pose& T_world_camera) {
  PlacedView best{T_world_camera};
  const SurfacePoints surface = surface_of(s);
  if (surface.points.empty()) return best;
  const Eigen::AlignedBox3d box = box_of(surface);
  const Vector3 forward = T_world_camera.linear().col(2), to_object = box.center() - T_world_camera.translation();
  // From as far as the next view, which is where the sensor is of use; else as near as the sensor allows.
  const DepthCameraConfig& sensor = s.configuration.sensor;
  const double radius = 0.5 * box.diagonal().norm(), reach = 0.9 * sensor.max_range;
  const double usual = (s.next_view.translation() - box.center()).norm();
  // A view is left where it is unless it would see twice as much from elsewhere.
  std::size_t enough = why_empty(s, T_world_camera).empty() ? 2 * sight_of(s, surface, T_world_camera).measurable : 0;
  // Along the axis; else, if the object is so far from it that it leaves the picture, towards the object.
  for (const Vector3& direction : {forward, Vector3(to_object.normalized())}) {
    for (const double distance : {std::min(usual, reach), std::min(sensor.min_range + radius, reach)}) {
      const double by = to_object.dot(direction) - distance;
      Pose moved = T_world_camera;
      moved.translation() += by * direction;
      const std::size_t measurable = sight_of(s, surface, moved).measurable;
      if (measurable <= enough || !why_empty(s, moved).empty()) continue;
      best = {moved, by};
      enough = 2 * measurable;
    }
  }
  return best;
}

}  // namespace nextview

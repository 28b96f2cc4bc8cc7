#include "ui/window/camera_control.hpp"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/view/pose.hpp"

namespace nextview {
namespace {

constexpr double turn_per_pixel = 0.006;  // [rad]
constexpr double zoom_per_step = 1.12;
constexpr double nearest_distance = 1e-3, farthest_distance = 1000.0;  // [m]

Vector3 forward_of(vtkCamera& camera) { return Vector3(camera.GetDirectionOfProjection()).normalized(); }

void stand(vtkRenderer& renderer, const Vector3& position, const Vector3& focus) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.SetPosition(position.data());
  camera.SetFocalPoint(focus.data());
  renderer.ResetCameraClippingRange();
}

/// How high the picture is where a point lies [m].
double height_at(vtkCamera& camera, const Vector3& point) {
  if (camera.GetParallelProjection()) return 2 * camera.GetParallelScale();
  const double depth = std::max((point - Vector3(camera.GetPosition())).dot(forward_of(camera)), nearest_distance);
  return 2 * depth * std::tan(camera.GetViewAngle() * std::numbers::pi / 360);
}

void shift(vtkRenderer& renderer, const Vector3& by) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  stand(renderer, Vector3(camera.GetPosition()) + by, Vector3(camera.GetFocalPoint()) + by);
}

}  // namespace

void orbit(vtkRenderer& renderer, const Vector3& pivot, double x, double y) {
  turn(renderer, pivot, -x * turn_per_pixel, y * turn_per_pixel);
}

void turn(vtkRenderer& renderer, const Vector3& pivot, double by_azimuth, double by_elevation) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Vector3 forward = forward_of(camera);
  const Vector3 right = forward.cross(Vector3(camera.GetViewUp())).normalized();
  const double now = std::asin(std::clamp(-forward.z(), -1.0, 1.0));
  const double elevation = std::clamp(now + by_elevation, -max_elevation, max_elevation);
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(by_azimuth, Vector3::UnitZ()) * Eigen::AngleAxisd(now - elevation, right)).toRotationMatrix();
  const auto turned = [&](const Vector3& point) -> Vector3 { return pivot + R * (point - pivot); };
  camera.SetViewUp(0, 0, 1);
  stand(renderer, turned(Vector3(camera.GetPosition())), turned(Vector3(camera.GetFocalPoint())));
}

void pan(vtkRenderer& renderer, const Vector3& pivot, double x, double y) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Vector3 forward = forward_of(camera);
  const Vector3 right = forward.cross(Vector3(camera.GetViewUp())).normalized();
  const double metres_per_pixel = height_at(camera, pivot) / std::max(renderer.GetSize()[1], 1);
  shift(renderer, (right.cross(forward) * y - right * x) * metres_per_pixel);
}

void zoom(vtkRenderer& renderer, const Vector3& pivot, double steps) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Vector3 position(camera.GetPosition()), focus(camera.GetFocalPoint());
  if (camera.GetParallelProjection()) {
    const double now = camera.GetParallelScale(),
                 then = std::clamp(now / std::pow(zoom_per_step, steps), nearest_distance, farthest_distance);
    camera.SetParallelScale(then);
    const Vector3 aside = pivot - position - (pivot - position).dot(forward_of(camera)) * forward_of(camera);
    return shift(renderer, (1 - then / now) * aside);
  }
  const double distance = (position - pivot).norm();
  const double scale =
      std::clamp(distance / std::pow(zoom_per_step, steps), nearest_distance, farthest_distance) / distance;
  stand(renderer, pivot + scale * (position - pivot), pivot + scale * (focus - pivot));
}

void centre(vtkRenderer& renderer, const Vector3& point) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Vector3 forward = forward_of(camera), to_point = point - Vector3(camera.GetPosition());
  shift(renderer, to_point - to_point.dot(forward) * forward);
}

Pose camera_pose(vtkRenderer& renderer) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  Pose pose = Pose::Identity();
  const Vector3 forward = Vector3(camera.GetDirectionOfProjection()).normalized();
  const Vector3 right = forward.cross(Vector3(camera.GetViewUp())).normalized();
  pose.linear() << right, forward.cross(right), forward;
  pose.translation() = Vector3(camera.GetPosition());
  return pose;
}

void look_through(vtkRenderer& renderer, const Pose& T_world_camera, const Vector3& target, double vertical_angle) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Vector3 position = T_world_camera.translation(), forward = T_world_camera.linear().col(2);
  // The target may lie behind it.
  const double min_distance = std::max(0.1 * (target - position).norm(), nearest_distance);
  const Vector3 focus = position + std::max((target - position).dot(forward), min_distance) * forward;
  const Vector3 up = -T_world_camera.linear().col(1);
  camera.SetPosition(position.data());
  camera.SetFocalPoint(focus.data());
  camera.SetViewUp(up.data());
  camera.SetViewAngle(vertical_angle);
}

}  // namespace nextview

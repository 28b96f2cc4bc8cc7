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
constexpr double steepest = 89.0 * std::numbers::pi / 180;  // straight from above, the z axis would be no direction
constexpr double nearest = 1e-3, farthest = 1000.0;         // [m]

}  // namespace

void orbit(vtkRenderer& renderer, double x, double y) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Vector3 focus(camera.GetFocalPoint());
  const Vector3 from_focus = Vector3(camera.GetPosition()) - focus;
  const double distance = from_focus.norm();
  const double azimuth = std::atan2(from_focus.y(), from_focus.x()) - x * turn_per_pixel;
  const double now = std::asin(std::clamp(from_focus.z() / distance, -1.0, 1.0));
  const double elevation = std::clamp(now + y * turn_per_pixel, -steepest, steepest);
  const Vector3 position = focus + distance * Vector3(std::cos(elevation) * std::cos(azimuth),
                                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  camera.SetPosition(position.data());
  camera.SetViewUp(0, 0, 1);
  renderer.ResetCameraClippingRange();
}

void pan(vtkRenderer& renderer, double x, double y) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Vector3 forward(camera.GetDirectionOfProjection());
  const Vector3 right = forward.cross(Vector3(camera.GetViewUp())).normalized();
  const double height = 2 * camera.GetDistance() * std::tan(camera.GetViewAngle() * std::numbers::pi / 360);
  const double metres_per_pixel = height / std::max(renderer.GetSize()[1], 1);
  const Vector3 shift = (right.cross(forward) * y - right * x) * metres_per_pixel;
  const Vector3 position = Vector3(camera.GetPosition()) + shift, focus = Vector3(camera.GetFocalPoint()) + shift;
  camera.SetPosition(position.data());
  camera.SetFocalPoint(focus.data());
  renderer.ResetCameraClippingRange();
}

void zoom(vtkRenderer& renderer, double steps) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const double distance = std::clamp(camera.GetDistance() / std::pow(zoom_per_step, steps), nearest, farthest);
  const Vector3 position = Vector3(camera.GetFocalPoint()) - Vector3(camera.GetDirectionOfProjection()) * distance;
  camera.SetPosition(position.data());
  renderer.ResetCameraClippingRange();
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
  const double min_distance = std::max(0.1 * (target - position).norm(), nearest);
  const Vector3 focus = position + std::max((target - position).dot(forward), min_distance) * forward;
  const Vector3 up = -T_world_camera.linear().col(1);
  camera.SetPosition(position.data());
  camera.SetFocalPoint(focus.data());
  camera.SetViewUp(up.data());
  camera.SetViewAngle(vertical_angle);
}

}  // namespace nextview

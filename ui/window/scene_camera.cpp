// Where the scene is looked at from.
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "ui/layers/geometry.hpp"
#include "ui/scene/camera_framing.hpp"
#include "ui/window/camera_control.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

std::vector<Vector3> SceneView::object_outline() {
  if (!shown_) return scene_.outline();
  const SessionSnapshot& s = *shown_;
  if (s.mesh) {
    if (std::exchange(outlined_, s.mesh) != s.mesh) outline_ = extreme_points(s.mesh->vertices);
    return outline_;
  }
  if (s.is_recording()) return extreme_points(s.setup->recorded->samples());  // of all frames, before any is taken
  const Eigen::AlignedBox3d region = s.grid.box();
  std::vector<Eigen::Vector3f> inside;
  for (const Eigen::Vector3f& point : s.cloud->points)
    if (region.contains(point.cast<double>())) inside.push_back(point);
  const auto outline = extreme_points(inside.empty() ? s.cloud->points : inside);
  if (!outline.empty()) return outline;
  const std::span<const Vector3> voxels = scene_.octree().outline();  // of a map alone they are all that there is
  return voxels.empty() ? corners(region) : std::vector<Vector3>(voxels.begin(), voxels.end());
}

void SceneView::move(const CameraMotion& motion) {
  const bool relative =
      std::holds_alternative<camera_motion::Zoom>(motion) || std::holds_alternative<camera_motion::Turn>(motion);
  if (!relative && shown_) pivot_ = 0.5 * (shown_->grid.lower() + shown_->grid.upper());
  if (const auto* frame = std::get_if<camera_motion::Frame>(&motion)) {
    if (frame->what == Framed::all)
      scene_.frame();
    else
      scene_.frame(frame->what == Framed::object || !shown_ ? object_outline()
                                                            : corners({shown_->grid.lower(), shown_->grid.upper()}));
  }
  if (const auto* from = std::get_if<camera_motion::LookFrom>(&motion))
    scene_.frame(object_outline(), ViewDirection{from->azimuth, from->elevation});
  if (const auto* by = std::get_if<camera_motion::Turn>(&motion))
    turn(renderer(), pivot_, by->azimuth * std::numbers::pi / 180, by->elevation * std::numbers::pi / 180);
  if (const auto* through = std::get_if<camera_motion::LookThrough>(&motion); through && shown_) {
    const double angle = 2 * std::atan(0.5 * shown_->camera.height / shown_->camera.fy);  // all that the camera sees
    look_through(renderer(), through->T_world_camera, pivot_, angle * 180 / std::numbers::pi);
  }
  if (const auto* to = std::get_if<camera_motion::GoTo>(&motion)) {
    const bool orthographic = orthographic_;
    scene_.set_orthographic(false, pivot_);
    look_through(renderer(), to->T_world_camera, pivot_, Scene::vertical_angle);
    scene_.set_orthographic(orthographic, pivot_);
  }
  if (const auto* step = std::get_if<camera_motion::Zoom>(&motion)) zoom(renderer(), pivot_, step->steps);
  renderer().ResetCameraClippingRange();
}

void SceneView::keep_in_sight(double narrowed) {
  constexpr double mostly = 1.5;  // who looks at a detail goes on with that
  const std::vector<Vector3> object = object_outline();
  const Eigen::Vector2d middle(rectangle_.x + rectangle_.width / 2, rectangle_.y + rectangle_.height / 2);
  Eigen::Vector2d reach(0, 0);  // in half sizes of the scene
  for (const Vector3& point : object) {
    const auto pixel = project(point);
    if (!pixel) return;
    const Eigen::Vector2d off = (*pixel - middle).cwiseAbs();
    reach = reach.cwiseMax(Eigen::Vector2d(2 * off.x() / rectangle_.width, 2 * off.y() / rectangle_.height));
  }
  if (reach.x() <= 1 || reach.x() > mostly * narrowed || reach.y() > mostly) return;
  const Vector3 back = -camera_pose().linear().col(2);
  constexpr double degrees = 180 / std::numbers::pi;
  move(camera_motion::LookFrom{degrees * std::atan2(back.y(), back.x()), degrees * std::asin(back.z())});
}

void SceneView::set_quality(DrawingQuality quality) {
  const bool fast = quality != DrawingQuality::still;
  scene_.set_quality(quality);
  scene_.cloud().set_coarse(fast);
  scene_.mesh().set_coarse(fast);
  scene_.missed().set_coarse(fast);
  scene_.surface().set_coarse(fast);
}

Pose SceneView::camera_pose() { return nextview::camera_pose(renderer()); }

}  // namespace nextview

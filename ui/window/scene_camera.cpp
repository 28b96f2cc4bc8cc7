// Where the scene is looked at from.
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <cmath>
#include <numbers>

#include "ui/layers/geometry.hpp"
#include "ui/window/camera_control.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

std::vector<Vector3> SceneView::object_corners() const {
  if (!shown_) return scene_.outline();
  const SessionSnapshot& s = *shown_;
  if (s.mesh) return corners(s.mesh->bounding_box());
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& point : s.cloud->points) box.extend(point.cast<double>());
  const Eigen::AlignedBox3d region(s.grid.lower(), s.grid.upper());
  return corners(box.isEmpty() ? region : box.intersection(region).isEmpty() ? box : box.intersection(region));
}

void SceneView::move(const CameraMotion& motion) {
  const bool relative =
      std::holds_alternative<camera_motion::Zoom>(motion) || std::holds_alternative<camera_motion::Turn>(motion);
  if (!relative && shown_) pivot_ = 0.5 * (shown_->grid.lower() + shown_->grid.upper());
  if (const auto* frame = std::get_if<camera_motion::Frame>(&motion)) {
    if (frame->what == Framed::all)
      scene_.frame();
    else
      scene_.frame(frame->what == Framed::object || !shown_ ? object_corners()
                                                            : corners({shown_->grid.lower(), shown_->grid.upper()}));
  }
  if (const auto* from = std::get_if<camera_motion::LookFrom>(&motion))
    scene_.frame(object_corners(), ViewDirection{from->azimuth, from->elevation});
  if (const auto* by = std::get_if<camera_motion::Turn>(&motion))
    turn(renderer(), pivot_, by->azimuth * std::numbers::pi / 180, by->elevation * std::numbers::pi / 180);
  if (const auto* through = std::get_if<camera_motion::LookThrough>(&motion); through && shown_) {
    const double angle = 2 * std::atan(0.5 * shown_->camera.height / shown_->camera.fy);  // all that the camera sees
    look_through(renderer(), through->T_world_camera, pivot_, angle * 180 / std::numbers::pi);
  }
  if (const auto* step = std::get_if<camera_motion::Zoom>(&motion)) zoom(renderer(), pivot_, step->steps);
  renderer().ResetCameraClippingRange();
}

void SceneView::set_in_motion(bool in_motion) {
  scene_.set_moving(in_motion);
  scene_.cloud().set_flat(in_motion);
}

Pose SceneView::camera_pose() { return nextview::camera_pose(renderer()); }

}  // namespace nextview

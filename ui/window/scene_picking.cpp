// What is at a place of the scene, and where something of the scene is.
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/window/scene_view.hpp"
#include "ui/workbench/chosen_voxels.hpp"

namespace nextview {
namespace {

constexpr double frustum_reach = 14.0, ray_reach = 5.0;  // [px]

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double t = along.squaredNorm() > 0 ? std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

}  // namespace

std::optional<Eigen::Vector2d> SceneView::project(const Vector3& point) {
  vtkMatrix4x4* projection =
      renderer().GetActiveCamera()->GetCompositeProjectionTransformMatrix(renderer().GetTiledAspectRatio(), -1, 1);
  double clip[4] = {point.x(), point.y(), point.z(), 1.0};
  projection->MultiplyPoint(clip, clip);
  if (clip[3] <= 0) return {};
  return Eigen::Vector2d(rectangle_.x + (clip[0] / clip[3] + 1) / 2 * rectangle_.width,
                         rectangle_.y + (1 - clip[1] / clip[3]) / 2 * rectangle_.height);
}

Sight SceneView::sight(double x, double y) {
  const Pose pose = camera_pose();
  const double up = std::tan(renderer().GetActiveCamera()->GetViewAngle() * std::numbers::pi / 360);
  const double right = up * rectangle_.width / rectangle_.height;
  const double u = 2 * (x - rectangle_.x) / rectangle_.width - 1, v = 2 * (y - rectangle_.y) / rectangle_.height - 1;
  return {pose.translation(), pose.linear() * Vector3(u * right, v * up, 1)};
}

Picked SceneView::pick(double x, double y) {
  Picked picked;
  if (!shown_ || doubtful_) return picked;
  const SessionSnapshot& s = *shown_;
  const Eigen::Vector2d pointer(x, y);
  const double depth = frustum_depth(s.candidates, 0.5 * (s.grid.lower() + s.grid.upper()));
  double least = frustum_reach;
  for (std::size_t i = 0; choice_.views && i < s.candidates.size(); ++i) {
    const auto pixel = project(s.candidates[i] * Vector3(0, 0, 0.5 * depth));
    const double distance = pixel ? (*pixel - pointer).norm() : least;
    if (distance >= least) continue;
    least = distance;
    picked.candidate = i;
  }
  if (picked.candidate) return picked;
  if (choice_.octree) {
    const auto [origin, direction] = sight(x, y);
    picked.voxel = voxel_on_ray(origin, direction, s.grid, chosen_voxels(s, choice_.map), choice_.voxels);
    if (picked.voxel) return picked;
  }
  least = ray_reach;
  for (const RaySegment& ray : rays_) {
    const auto from = project(ray.from), to = project(ray.to);
    if (!choice_.rays || !from || !to) continue;
    const double distance = distance_to_segment(pointer, *from, *to);
    if (distance >= least) continue;
    least = distance;
    picked.ray = ray.index;
  }
  return picked;
}

}  // namespace nextview

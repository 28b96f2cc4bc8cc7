// What is at a place of the scene, and where something of the scene is.
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ui/window/scene_view.hpp"
#include "ui/workbench/chosen_voxels.hpp"

namespace nextview {
namespace {

constexpr double frustum_reach = 14.0, ray_reach = 3.0;  // [px]

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
  vtkCamera& camera = *renderer().GetActiveCamera();
  if (camera.GetParallelProjection()) {
    const double high = camera.GetParallelScale(), wide = high * rectangle_.width / rectangle_.height;
    return {pose * Vector3(u * wide, v * high, 0), pose.linear().col(2)};
  }
  return {pose.translation(), pose.linear() * Vector3(u * right, v * up, 1)};
}

/// What was measured there, whether its voxels are shown or not: the object, or the points, lie where they do.
std::optional<std::uint32_t> SceneView::occupied_voxel(double x, double y) {
  const auto [origin, direction] = sight(x, y);
  VoxelFilter filter;
  filter.section = choice_.section;
  return voxel_on_ray(origin, direction, shown_->grid, chosen_voxels(*shown_, choice_.map), filter);
}

bool SceneView::set_pivot(double x, double y) {
  if (!shown_ || doubtful_) return false;
  const auto voxel = occupied_voxel(x, y);
  if (voxel) pivot_ = shown_->grid.centre(*voxel);
  return voxel.has_value();
}

namespace {

constexpr double point_reach = 6.0;  // [px]

/// The first of a mesh's triangles along a ray, of what a section leaves, by Möller and Trumbore 1997. `direction` of
/// any length but 0.
std::optional<Vector3> first_hit(const TriangleMesh& mesh, const Vector3& origin, const Vector3& direction,
                                 const std::optional<Section>& section) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.vertices[t[0]].cast<double>();
    const Vector3 u = mesh.vertices[t[1]].cast<double>() - a, v = mesh.vertices[t[2]].cast<double>() - a;
    const Vector3 across = direction.cross(v);
    const double volume = u.dot(across);
    if (volume == 0.0) continue;
    const Vector3 from = origin - a, around = from.cross(u);
    const double p = from.dot(across) / volume, q = direction.dot(around) / volume, way = v.dot(around) / volume;
    if (p < 0 || q < 0 || p + q > 1 || way <= 0 || way >= nearest) continue;
    if (!section || section->holds(origin + way * direction)) nearest = way;
  }
  if (!std::isfinite(nearest)) return std::nullopt;
  return origin + nearest * direction;
}

}  // namespace

std::optional<Vector3> SceneView::surface_point(double x, double y) {
  if (!shown_ || doubtful_) return std::nullopt;
  const auto [origin, direction] = sight(x, y);
  // Through a ghost one points at what was measured.
  const bool seen_through = choice_.object_style == MeshStyle::ghost && (choice_.cloud || shown_surface());
  if (choice_.object && shown_->mesh && !seen_through)
    if (const auto hit = first_hit(*shown_->mesh, origin, direction, choice_.section)) return hit;
  if (const TriangleMesh* surface = shown_surface())
    if (const auto hit = first_hit(*surface, origin, direction, choice_.section)) return hit;
  if (choice_.cloud) {
    std::optional<Vector3> best;
    double least = point_reach;
    const Vector3 unit = direction.normalized();
    vtkCamera& camera = *renderer().GetActiveCamera();
    const bool parallel = camera.GetParallelProjection();
    const double pixels =
        0.5 * rectangle_.height /
        (parallel ? camera.GetParallelScale() : std::tan(camera.GetViewAngle() * std::numbers::pi / 360));
    const auto voxel = occupied_voxel(x, y);  // what lies behind that is not seen
    const double farthest = voxel ? (shown_->grid.centre(*voxel) - origin).dot(unit) + 2 * shown_->grid.resolution
                                  : std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3f& point : shown_->cloud->points) {
      const Vector3 from = point.cast<double>() - origin;
      const double depth = from.dot(unit);
      if (depth <= 0 || depth > farthest || (choice_.section && !choice_.section->holds(point.cast<double>())))
        continue;
      const double off = (from - depth * unit).norm() * pixels / (parallel ? 1.0 : depth);
      if (off >= least) continue;
      least = off;
      best = point.cast<double>();
    }
    if (best) return best;
  }
  if (const auto voxel = occupied_voxel(x, y)) return shown_->grid.centre(*voxel);
  return std::nullopt;
}

Picked SceneView::pick(double x, double y) {
  Picked picked;
  if (!shown_ || doubtful_) return picked;
  const SessionSnapshot& s = *shown_;
  const Eigen::Vector2d pointer(x, y);
  const double depth = frustum_depth(s.candidates, 0.5 * (s.grid.lower() + s.grid.upper()));
  double least = frustum_reach;
  for (std::size_t i = 0; choice_.views && i < s.candidates.size(); ++i) {
    if (i < hidden_.size() && hidden_[i]) continue;
    const auto pixel = project(s.candidates[i] * Vector3(0, 0, 0.5 * depth));
    const double distance = pixel ? (*pixel - pointer).norm() : least;
    if (distance >= least) continue;
    least = distance;
    picked.candidate = i;
  }
  if (picked.candidate) return picked;
  if (choice_.octree) {
    const auto [origin, direction] = sight(x, y);
    picked.voxel = voxel_on_ray(origin, direction, s.grid, chosen_voxels(s, choice_.map), choice_.shown_voxels());
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
  if (!picked.ray && (choice_.object || choice_.cloud || choice_.missed)) picked.voxel = occupied_voxel(x, y);
  return picked;
}

}  // namespace nextview

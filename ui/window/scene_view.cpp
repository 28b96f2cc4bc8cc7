#include "ui/window/scene_view.hpp"

#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <tuple>

#include "ui/figures/session_figure.hpp"

namespace nextview {
namespace {

/// Points drawn at most: more do not show, and a software renderer feels each.
constexpr std::size_t most_points = 50'000;

/// Enough to tell where the view's rays go and what they are worth, few enough to see what is behind them.
constexpr std::size_t rays_shown = 60;

PointCloud thinned(const PointCloud& cloud) {
  const std::size_t stride = cloud.size() / most_points + 1;
  PointCloud result;
  for (std::size_t i = 0; i < cloud.size(); i += stride) result.push_back(cloud[i]);
  return result;
}

auto as_tuple(const VoxelFilter& f) { return std::tuple(f.occupied, f.unknown, f.free, f.unknown_from); }

auto as_tuple(const LayerChoice& c) {
  return std::tuple(c.object, c.cloud, c.octree, c.views, c.rays, c.region, c.object_style, as_tuple(c.voxels),
                    c.colouring);
}

}  // namespace

SceneView::SceneView(RenderSurface& surface) : surface_(surface) { scene_.attach(surface); }

void SceneView::place(const Rectangle& rectangle) {
  rectangle_ = rectangle;
  const Viewport viewport = rectangle.in(surface_.width(), surface_.height());
  renderer().SetViewport(viewport.left, viewport.bottom, viewport.right, viewport.top);
}

bool SceneView::show(std::shared_ptr<const SessionSnapshot> snapshot, const LayerChoice& choice) {
  if (!snapshot->loaded()) return false;
  if (shown_ == snapshot && as_tuple(choice_) == as_tuple(choice)) return false;
  const bool new_session = !shown_ || shown_->session != snapshot->session;
  if (new_session) {
    scene_.mesh().show(*snapshot->mesh, choice.object_style);
    scene_.region().show({snapshot->grid.lower(), snapshot->grid.upper()});
  } else if (choice.object_style != choice_.object_style) {
    scene_.mesh().set_style(choice.object_style);
  }
  show_map(*snapshot, choice, new_session || shown_->map != snapshot->map);
  if (shown_ != snapshot) {
    show_views(*snapshot);
    show_rays(*snapshot);
  }
  scene_.mesh().set_visible(choice.object);
  scene_.cloud().set_visible(choice.cloud);
  scene_.octree().set_visible(choice.octree);
  scene_.views().set_visible(choice.views);
  scene_.rays().set_visible(choice.rays);
  scene_.region().set_visible(choice.region);
  scene_.annotate();
  shown_ = std::move(snapshot);
  choice_ = choice;
  if (new_session) frame();
  renderer().ResetCameraClippingRange();
  return true;
}

void SceneView::show_map(const SessionSnapshot& snapshot, const LayerChoice& choice, bool new_map) {
  if (new_map) scene_.cloud().show(thinned(*snapshot.cloud));
  if (new_map || as_tuple(choice.voxels) != as_tuple(choice_.voxels)) {
    scene_.octree().show(snapshot.grid, *snapshot.voxels, choice.voxels, choice.colouring);
  } else if (choice.colouring != choice_.colouring) {
    scene_.octree().set_colouring(choice.colouring);
  }
}

void SceneView::show_views(const SessionSnapshot& snapshot) {
  ViewsPicture picture;
  std::vector<double> scores;
  std::vector<std::size_t> visited;
  std::vector<Pose> path;
  for (const StepRecord& record : snapshot.records) {
    path.push_back(record.T_world_camera);
    if (record.view >= 0) visited.push_back(static_cast<std::size_t>(record.view));
  }
  if (!snapshot.records.empty()) {
    for (const Candidate& candidate : snapshot.records.back().candidates) scores.push_back(candidate.gain);
  }
  picture.camera = snapshot.camera;
  picture.candidates = snapshot.candidates;
  picture.scores = scores;
  picture.visited = visited;
  if (snapshot.finished.empty()) picture.chosen = snapshot.next_candidate;
  picture.path = path;
  picture.score_name = snapshot.configuration.planner.gain;
  picture.score_unit = snapshot.gain_unit;
  const Vector3 target = 0.5 * (snapshot.grid.lower() + snapshot.grid.upper());
  picture.reach = (snapshot.next_view.translation() - target).norm();
  scene_.views().show(picture);
}

void SceneView::show_rays(const SessionSnapshot& snapshot) {
  std::vector<RaySegment> segments;
  if (snapshot.explanation && snapshot.finished.empty()) {
    segments =
        ray_segments(*snapshot.explanation, snapshot.next_view.translation(), snapshot.grid.resolution, rays_shown);
  }
  scene_.rays().show(segments, {"contribution of a ray", snapshot.gain_unit});
}

void SceneView::frame() { scene_.frame(); }

std::optional<Eigen::Vector2d> SceneView::project(const Vector3& point) {
  vtkMatrix4x4* projection =
      renderer().GetActiveCamera()->GetCompositeProjectionTransformMatrix(renderer().GetTiledAspectRatio(), -1, 1);
  double clip[4] = {point.x(), point.y(), point.z(), 1.0};
  projection->MultiplyPoint(clip, clip);
  if (clip[3] <= 0) return {};
  return Eigen::Vector2d(rectangle_.x + (clip[0] / clip[3] + 1) / 2 * rectangle_.width,
                         rectangle_.y + (1 - clip[1] / clip[3]) / 2 * rectangle_.height);
}

}  // namespace nextview

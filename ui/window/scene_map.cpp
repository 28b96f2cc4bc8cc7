// What was measured, as the scene shows it: points, voxels, and the surface that was missed.
#include <algorithm>
#include <utility>

#include "ui/window/scene_view.hpp"
#include "ui/workbench/chosen_voxels.hpp"

namespace nextview {
namespace {

/// Points drawn at most: more do not show, and a software renderer feels each.
constexpr std::size_t max_points = 60'000;

}  // namespace

void SceneView::show_missed(const SessionSnapshot& s) {
  missed_ = s.missed;
  if (!missed_) return scene_.missed().show(TriangleMesh{});
  scene_.missed().show(
      *missed_->mesh,
      MeshClasses{missed_->observed, {{"missed so far", theme::missed}, {"measured", theme::object}}, "surface"});
}

void SceneView::show_cloud(const SessionSnapshot& s, const LayerChoice& choice) {
  const SeenCloud& cloud = *s.cloud;
  const std::size_t stride = cloud.points.size() / max_points + 1;
  SeenCloud thin;
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    thin.points.push_back(cloud.points[i]);
    thin.views.push_back(cloud.views[i]);
    if (!cloud.normals.empty()) thin.normals.push_back(cloud.normals[i]);
    if (!cloud.distances.empty()) thin.distances.push_back(cloud.distances[i]);
  }
  CloudPicture picture{thin.points, thin.views, thin.distances, chosen_cloud_colouring(s, choice)};
  picture.normals = thin.normals;
  picture.farthest = s.configuration.evaluation.d_reg;
  if (thin.distances.empty() && picture.colouring == CloudColouring::by_distance)
    picture.colouring = CloudColouring::single;  // they are not compared yet
  if (choice.ranges_locked && choice_.ranges_locked && heights_.first < heights_.second) {
    picture.heights = heights_;
  } else if (!thin.points.empty()) {
    const auto [low, high] = std::minmax_element(thin.points.begin(), thin.points.end(),
                                                 [](const auto& a, const auto& b) { return a.z() < b.z(); });
    heights_ = {low->z(), high->z()};
    if (choice.ranges_locked && heights_.first < heights_.second) picture.heights = heights_;
  }
  scene_.cloud().show(picture);
}

void SceneView::show_voxels(const SessionSnapshot& s, const LayerChoice& choice) {
  const auto values = chosen_values(s, choice);
  const auto colouring = chosen_colouring(s, choice);
  const auto faces = std::exchange(faces_, nullptr);
  const auto voxels = chosen_voxels(s, choice.map);
  const bool anew = std::exchange(voxels_are_old_, false);
  if (anew && faces && faces->are_of(s, choice)) {
    scene_.octree().show(faces->faces, s.grid, voxels, choice.shown_voxels(), colouring, values);
  } else if (anew) {
    scene_.octree().show(s.grid, voxels, choice.shown_voxels(), colouring, values);
  } else {
    scene_.octree().set_colouring(colouring, values);
  }
}

}  // namespace nextview

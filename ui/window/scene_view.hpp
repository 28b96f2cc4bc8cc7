#pragma once
#include <optional>

#include "ui/scene.hpp"
#include "ui/window/layout.hpp"
#include "ui/window/session_snapshot.hpp"

namespace nextview {

/// What of a session the scene shows, and how.
struct LayerChoice {
  bool object = true, cloud = true, octree = true, views = true, rays = true, region = true;
  MeshStyle object_style = MeshStyle::ghost;
  VoxelFilter voxels;
  VoxelColouring colouring = VoxelColouring::by_class;
};

/// The 3D part of the window: a scene that follows snapshots and does again only what changed.
class SceneView {
 public:
  explicit SceneView(RenderSurface& surface);

  /// In the surface as it is now; call it again when its size changed.
  void place(const Rectangle& rectangle);
  /// Returns whether the picture changed.
  bool show(std::shared_ptr<const SessionSnapshot> snapshot, const LayerChoice& choice);
  /// Frames all that is shown.
  void frame();

  const Rectangle& rectangle() const { return rectangle_; }
  vtkRenderer& renderer() { return scene_.renderer(); }
  /// Where a point of the world is in the window, unless it is behind the camera [px from the upper left corner].
  std::optional<Eigen::Vector2d> project(const Vector3& point);

 private:
  void show_views(const SessionSnapshot& snapshot);
  void show_rays(const SessionSnapshot& snapshot);
  void show_map(const SessionSnapshot& snapshot, const LayerChoice& choice, bool new_map);

  RenderSurface& surface_;
  Rectangle rectangle_;
  Scene scene_;
  std::shared_ptr<const SessionSnapshot> shown_;
  LayerChoice choice_;
};

}  // namespace nextview

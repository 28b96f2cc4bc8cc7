#pragma once
#include "ui/panels/panel.hpp"
#include "ui/window/box_handles.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

/// The region of interest as a box whose handles the pointer drags; let go, it becomes the setting map.region.
class RegionHandles {
 public:
  /// Once a frame, while the pointer does nothing else. Returns whether it is at a handle.
  bool follow(SceneView& view, const PanelContext& context);
  /// Over the scene, while the region is to be dragged.
  void draw(SceneView& view, const PanelContext& context) const;

 private:
  struct Drag {
    std::size_t handle;
    Sight from;
    Eigen::AlignedBox3d start;
  };
  void begin_or_point(SceneView& view, const PanelContext& context, const Eigen::AlignedBox3d& region);
  void drag(SceneView& view, const PanelContext& context);
  void draw_box(SceneView& view, const PanelContext& context) const;

  std::optional<Drag> drag_;
  std::optional<std::size_t> pointed_at_;
  std::optional<Eigen::AlignedBox3d> box_;  ///< as it is dragged, and after that until the session has it
};

}  // namespace nextview

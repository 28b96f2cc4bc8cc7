#pragma once
#include "ui/panels/panel.hpp"
#include "ui/window/region_handles.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

/// What the pointer does in the scene: it turns, moves and zooms, points at candidates, and picks what is clicked.
class ScenePointer {
 public:
  /// Once a frame, before the panels. Returns whether the scene's camera moved.
  bool follow(SceneView& view, const Rectangle* beside, const PanelContext& context);

  const RegionHandles& region_handles() const { return region_; }

 private:
  enum class Drag { none, orbit, pan };
  bool drag_camera(SceneView& view);
  void pick(SceneView& view, const PanelContext& context) const;

  Drag drag_ = Drag::none;
  RegionHandles region_;
};

}  // namespace nextview

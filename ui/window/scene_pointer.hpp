#pragma once
#include "ui/panels/panel.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {

/// What the pointer does in the scene: it turns, moves and zooms, points at candidates, and picks what is clicked.
class ScenePointer {
 public:
  /// Once a frame, before the panels. Returns whether the scene's camera moved.
  bool follow(SceneView& view, const PanelContext& context);

 private:
  enum class Drag { none, orbit, pan };
  bool drag_camera(SceneView& view);
  void pick(SceneView& view, const PanelContext& context) const;

  Drag drag_ = Drag::none;
};

}  // namespace nextview

#pragma once
#include <memory>

#include "ui/window/scene_view.hpp"

namespace nextview {

/// The right half of the scene, looked at by the same camera: the branch that a session is compared with, or else the
/// session once more with other layers.
class ComparedScene {
 public:
  ComparedScene(RenderTarget& target, double scale) : target_(target), scale_(scale) {}

  /// Shows it beside `view` in this part of the target, or gives `view` all of it. Returns whether that has changed.
  bool share(SceneView& view, const Rectangle& place, const std::shared_ptr<const SessionSnapshot>& session,
             const WindowState& window);
  /// Returns how much its picture changed.
  SceneChange show(const std::shared_ptr<const SessionSnapshot>& session, const WindowState& window,
                   std::shared_ptr<const FoundSurface> surface);
  void set_quality(DrawingQuality quality);
  void set_scale(double scale);
  /// The camera that both share shows what lies in either.
  void share_depth(SceneView& view);
  /// A picture of `view` with this beside it, half as wide each (SceneView::draw_apart); of `view` alone if there is
  /// nothing beside it.
  Image draw_apart(SceneView& view, const std::optional<PictureSize>& size, bool transparent, double degrees = 0);
  /// Null unless there is one.
  const Rectangle* rectangle() const { return beside_ ? &beside_->rectangle() : nullptr; }

 private:
  RenderTarget& target_;
  double scale_;
  std::unique_ptr<SceneView> beside_;
  std::string caption_, other_caption_;
  WindowState window_;  ///< with nothing selected: that is of the session
  std::shared_ptr<const Inspection> nothing_ = std::make_shared<const Inspection>();
};

}  // namespace nextview

#pragma once
#include <memory>
#include <vector>

#include "core/session/session.hpp"
#include "ui/figures/step_figure.hpp"
#include "ui/render_target/drawn_apart.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {

/// What of a scan the scene shows.
struct SceneLayers {
  bool object = true, cloud = true, map = true, views = true, rays = true, region = true;
  bool candidates = true;  ///< of the views; else the chosen one alone
  bool annotated = true;   ///< legends, axes and a scale bar
  bool dark = false;       ///< on dark paper
};

/// The scene of a session alone, as the window has it.
class SceneFigure {
 public:
  /// Draws in the target, which must live longer, beside what that shows.
  /// @pre the session has taken a step
  SceneFigure(RenderTarget& target, const Session& session, const SceneLayers& layers, const PictureSize& size);
  /// What one picture of a scan shows. `scale`: pixels a pixel of the design.
  SceneFigure(RenderTarget& target, const StepPicture& picture, const SceneLayers& layers, const PictureSize& size,
              double scale);
  ~SceneFigure();

  /// All of what is shown.
  Image draw(const ViewDirection& direction, bool transparent);
  /// These points [m, world], and what lies around them.
  Image draw(const ViewDirection& direction, std::span<const Vector3> points);
  /// One of `count` pictures from all around, each at the same distance.
  Image draw_turned(const ViewDirection& start, int frame, int count, bool transparent);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace nextview

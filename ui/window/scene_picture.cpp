// The scene of the window as a picture of its own.
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/window/scene_view.hpp"

namespace nextview {
namespace {

/// All that is seen in the window stays in sight: in a narrower picture the angle becomes larger.
void widen(vtkCamera& camera, double aspect_in_window, double aspect) {
  if (aspect >= aspect_in_window) return;
  const double half = camera.GetViewAngle() * std::numbers::pi / 360;
  camera.SetViewAngle(std::atan(std::tan(half) * aspect_in_window / aspect) * 360 / std::numbers::pi);
}

}  // namespace

Image SceneView::draw_apart(const std::optional<PictureSize>& wanted, bool transparent, double degrees) {
  const auto side = [](double pixels) { return std::clamp(int(pixels), smallest_picture, largest_picture); };
  const PictureSize size = wanted.value_or(PictureSize{side(rectangle_.width), side(rectangle_.height)});
  /// As it was, also where drawing fails.
  struct AsItWas {
    SceneView& view;
    Scene::Stand stand = view.scene_.stand();
    ~AsItWas() {
      view.scene_.restore(stand);
      view.scene_.set_scale(view.scale_);
      view.scene_.set_backed(true);
      view.place(view.rectangle_);
      view.scene_.annotate();
    }
  } as_it_was{*this};
  DrawnApart apart(target_, {&renderer()}, size);
  renderer().SetViewport(0, 0, 1, 1);
  if (wanted) scene_.set_scale(picture_scale(size));
  scene_.set_backed(!transparent);
  if (shown_) scene_.turn(as_it_was.stand, 0.5 * (shown_->grid.lower() + shown_->grid.upper()), degrees);
  const double height = std::max(rectangle_.height, 1.0);
  widen(*renderer().GetActiveCamera(), std::max(rectangle_.width, 1.0) / height, double(size.width) / size.height);
  scene_.annotate();
  return apart.draw(transparent);
}

}  // namespace nextview

#include "ui/window/compared_scene.hpp"

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "core/file/counted.hpp"

namespace nextview {
namespace {

std::string caption(const std::string& branch, const SessionSnapshot& session) {
  return fmt::format("{} · {}", branch, counted(session.records.size(), "view"));
}

std::string caption_of(SecondView second) {
  switch (second) {
    case SecondView::object:
      return "object";
    case SecondView::surface:
      return "reconstructed surface";
    case SecondView::cloud:
      return "measured points";
    case SecondView::octree:
      return "occupancy map";
    case SecondView::gibbs:
      return "Gibbs map";
    case SecondView::missed:
      return "missed surface";
    case SecondView::none:
      break;
  }
  return "";
}

}  // namespace

bool ComparedScene::share(SceneView& view, const Rectangle& place, const std::shared_ptr<const SessionSnapshot>& shown,
                          const WindowState& window) {
  const SessionSnapshot& session = *shown;
  const bool compared = session.compared != nullptr;
  const bool wanted = compared || (session.loaded() && window.layers.second != SecondView::none);
  const bool there_was = beside_ != nullptr;
  Rectangle left = place, right = place;
  if (wanted) {
    left.width = std::floor(place.width / 2);
    right.x += left.width;
    right.width -= left.width;
  }
  const std::string of_session = compared ? caption(session.timeline->branches.current().name, session) : "";
  const std::string of_other = compared ? caption(session.compared->branch, *session.compared->snapshot)
                               : wanted ? caption_of(window.layers.second)
                                        : "";
  const bool same_place = view.rectangle() == left && wanted == there_was;
  if (same_place && of_session == caption_ && of_other == other_caption_) return false;
  if (!wanted) beside_.reset();
  if (wanted && !there_was) beside_ = std::make_unique<SceneView>(target_, scale_);
  view.layers().set_caption(caption_ = of_session);
  if (beside_) beside_->layers().set_caption(of_other);
  other_caption_ = of_other;
  if (!same_place) view.place(left);
  if (beside_) beside_->place(right);
  if (beside_ && !there_was) {
    show(shown, window, nullptr);  // it frames its own camera, which goes then
    beside_->renderer().SetActiveCamera(view.renderer().GetActiveCamera());
  }
  return true;
}

SceneChange ComparedScene::show(const std::shared_ptr<const SessionSnapshot>& session, const WindowState& window,
                                std::shared_ptr<const FoundSurface> surface) {
  if (!beside_) return SceneChange::none;
  window_.dark = window.dark;
  window_.orthographic = window.orthographic;
  if (session->compared) {
    window_.layers = window.layers;
    return beside_->show(session->compared->snapshot, window_, nothing_);
  }
  window_.layers = window.layers.of_second();
  return beside_->show(session, window_, nothing_, nullptr, std::move(surface));
}

void ComparedScene::set_scale(double scale) {
  scale_ = scale;
  if (beside_) beside_->set_scale(scale);
}

void ComparedScene::share_depth(SceneView& view) {
  if (!beside_) return;
  vtkCamera& camera = *view.renderer().GetActiveCamera();
  view.renderer().ResetCameraClippingRange();
  const double near = camera.GetClippingRange()[0], far = camera.GetClippingRange()[1];
  beside_->renderer().ResetCameraClippingRange();
  camera.SetClippingRange(std::min(near, camera.GetClippingRange()[0]), std::max(far, camera.GetClippingRange()[1]));
}

Image ComparedScene::draw_apart(SceneView& view, const std::optional<PictureSize>& size, bool transparent,
                                double degrees) {
  if (!beside_) return view.draw_apart(size, transparent, degrees);
  auto left = size, right = size;
  if (size) {
    left->width = std::max(smallest_picture, size->width / 2);
    right->width = std::max(smallest_picture, size->width - left->width);
  }
  const Image first = view.draw_apart(left, transparent, degrees);
  return side_by_side(first, beside_->draw_apart(right, transparent, degrees));
}

void ComparedScene::set_quality(DrawingQuality quality) {
  if (beside_) beside_->set_quality(quality);
}

}  // namespace nextview

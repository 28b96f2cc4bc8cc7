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

}  // namespace

bool ComparedScene::share(SceneView& view, const Rectangle& place, const SessionSnapshot& session) {
  const bool wanted = session.compared != nullptr, there_was = beside_ != nullptr;
  Rectangle left = place, right = place;
  if (wanted) {
    left.width = std::floor(place.width / 2);
    right.x += left.width;
    right.width -= left.width;
  }
  const std::string of_session = wanted ? caption(session.timeline->branches.current().name, session) : "";
  const std::string of_other = wanted ? caption(session.compared->branch, *session.compared->snapshot) : "";
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
    show(session, window_.layers);  // it frames its own camera, which goes then
    beside_->renderer().SetActiveCamera(view.renderer().GetActiveCamera());
  }
  return true;
}

bool ComparedScene::show(const SessionSnapshot& session, const LayerChoice& layers) {
  if (!beside_ || !session.compared) return false;
  window_.layers = layers;
  return beside_->show(session.compared->snapshot, window_, nothing_);
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

void ComparedScene::set_in_motion(bool in_motion) {
  if (beside_) beside_->set_in_motion(in_motion);
}

}  // namespace nextview

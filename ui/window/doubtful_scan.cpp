// What the scene shows while the operator decides on a scan that does not fit those before it.
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/panels/question.hpp"
#include "ui/window/scene_view.hpp"

namespace nextview {
namespace {

/// Points of each cloud drawn at most.
constexpr std::size_t most_points = 40'000;

std::vector<Eigen::Vector3f> some(std::span<const Eigen::Vector3f> points) {
  std::vector<Eigen::Vector3f> kept;
  const std::size_t stride = points.size() / most_points + 1;
  for (std::size_t i = 0; i < points.size(); i += stride) kept.push_back(points[i]);
  return kept;
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace

/// The clouds take the place of all layers, whatever those are, and are framed from the side that was looked at.
void SceneView::show_doubtful(const SessionSnapshot& s) {
  const auto so_far = some(s.cloud->points), reached = some(doubtful_->reached), corrected = some(doubtful_->corrected);
  scene_.fit().show(std::array{FitLayer::Cloud{so_far, theme::cloud}, FitLayer::Cloud{reached, theme::new_scan},
                               FitLayer::Cloud{corrected, theme::corrected_scan}});
  stand_before_ = scene_.stand();
  scene_.set_covered_below(question_height);
  const Vector3 forward = camera_pose().linear().col(2);
  scene_.frame(ViewDirection{degrees(std::atan2(-forward.y(), -forward.x())),
                             degrees(std::asin(std::clamp(-forward.z(), -1.0, 1.0)))});
}

/// All is as it was before the question.
void SceneView::leave_doubtful() {
  scene_.fit().show({});
  scene_.set_covered_below(0);
  scene_.restore(stand_before_);
}

}  // namespace nextview

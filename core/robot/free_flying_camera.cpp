#include <algorithm>
#include <stdexcept>

#include "core/robot/robot.hpp"

namespace nextview {

FreeFlyingCamera::FreeFlyingCamera(const Pose& start, double speed, double turn_rate)
    : pose_(start), speed_(speed), turn_rate_(turn_rate) {
  if (!(speed > 0.0) || !(turn_rate > 0.0))
    throw std::invalid_argument("free-flying camera: speed and turn rate must be greater than 0");
}

std::vector<Reach> FreeFlyingCamera::reach(const Pose& from, std::span<const View> views) {
  std::vector<Reach> result;
  for (const View& view : views) {
    const Pose& to = view.T_world_camera;
    const double distance = (to.translation() - from.translation()).norm();
    const double rotation = rotation_angle(from, to);
    result.push_back({to.matrix().allFinite() ? "" : "the pose is not finite",
                      {distance, rotation, std::max(distance / speed_, rotation / turn_rate_)}});
  }
  return result;
}

Result<Pose> FreeFlyingCamera::move_to(const View& view, std::stop_token stop) {
  if (stop.stop_requested()) return Failure{Failure::cancelled, "the move was cancelled"};
  if (!view.T_world_camera.matrix().allFinite()) return Failure{Failure::unreachable, "the pose is not finite"};
  return pose_ = view.T_world_camera;
}

}  // namespace nextview

#include "core/robot/robot.hpp"

#include <algorithm>
#include <stdexcept>

namespace nextview {

FreeFlyingCamera::FreeFlyingCamera(const Pose& start, double speed, double turn_rate)
    : pose_(start), speed_(speed), turn_rate_(turn_rate) {
  if (!(speed > 0.0) || !(turn_rate > 0.0))
    throw std::invalid_argument("free-flying camera: speed and turn rate must be greater than 0");
}

std::optional<std::string> FreeFlyingCamera::unreachable(const Pose& T_world_camera) const {
  if (!T_world_camera.matrix().allFinite()) return "the pose is not finite";
  return std::nullopt;
}

MotionCost FreeFlyingCamera::cost(const Pose& from, const Pose& to) const {
  const double distance = (to.translation() - from.translation()).norm();
  const double rotation = rotation_angle(from, to);
  return {distance, rotation, std::max(distance / speed_, rotation / turn_rate_)};
}

void FreeFlyingCamera::move_to(const Pose& T_world_camera) {
  if (const auto reason = unreachable(T_world_camera)) throw std::runtime_error("free-flying camera: " + *reason);
  pose_ = T_world_camera;
}

}  // namespace nextview

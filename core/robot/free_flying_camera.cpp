#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/robot/robot.hpp"

namespace nextview {

std::string outside(const std::optional<Eigen::AlignedBox3d>& volume, const Vector3& camera) {
  if (!volume || volume->contains(camera)) return {};
  return fmt::format("the camera at ({:.3g}, {:.3g}, {:.3g}) m would leave the working volume (robot.working_volume)",
                     camera.x(), camera.y(), camera.z());
}

FreeFlyingCamera::FreeFlyingCamera(const Pose& start, double speed, double turn_rate)
    : pose_(start), speed_(speed), turn_rate_(turn_rate) {
  if (!(speed > 0.0) || !(turn_rate > 0.0))
    throw std::invalid_argument("free-flying camera: speed and turn rate must be greater than 0");
}

std::string FreeFlyingCamera::forbidden(const Pose& T_world_camera) const {
  if (!T_world_camera.matrix().allFinite()) return "the pose is not finite";
  return outside(volume_, T_world_camera.translation());
}

std::vector<Reach> FreeFlyingCamera::reach(const Pose& from, std::span<const View> views) {
  std::vector<Reach> result;
  for (const View& view : views) {
    const Pose& to = view.T_world_camera;
    const double distance = (to.translation() - from.translation()).norm();
    const double rotation = rotation_angle(from, to);
    result.push_back({forbidden(to), {distance, rotation, std::max(distance / speed_, rotation / turn_rate_)}});
  }
  return result;
}

Result<Pose> FreeFlyingCamera::move_to(const View& view, std::stop_token stop) {
  if (stop.stop_requested()) return Failure{Failure::cancelled, "the move was cancelled"};
  if (std::string why = forbidden(view.T_world_camera); !why.empty()) return Failure{Failure::unreachable, why};
  return pose_ = view.T_world_camera;
}

}  // namespace nextview

#include "core/robot/pose_error.hpp"

#include <numbers>

#include "core/random/counter_random.hpp"
#include "core/random/on_sphere.hpp"

namespace nextview {

std::vector<Setting> settings(RobotConfig& c) {
  return {
      {"robot.position_error", "m", "for trials: standard deviation of where the camera is, along each axis",
       &c.position_error, from_to(0, 10)},
      {"robot.rotation_error", "deg", "for trials: standard deviation of how the camera is turned, about any axis",
       &c.rotation_error, from_to(0, 90)},
  };
}

void RobotConfig::validate() const { require_in_bounds(*this); }

Pose pose_error(const RobotConfig& config, std::uint64_t seed, std::uint32_t step) {
  if (step <= 1) return Pose::Identity();
  const CounterRandom random(seed, random_stream::pose_errors, step);
  const auto [x, y] = random.normal(0);
  const auto [z, turn] = random.normal(1);
  const auto axis = random.uniform(2);
  const double angle = config.rotation_error * turn * std::numbers::pi / 180.0;
  return make_pose(config.position_error * Vector3(x, y, z),
                   Eigen::Quaterniond(Eigen::AngleAxisd(angle, on_sphere(axis[0], axis[1]))));
}

}  // namespace nextview

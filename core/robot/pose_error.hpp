#pragma once
#include <cstdint>
#include <vector>

#include "core/setting/setting.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// How wrong a simulated robot is about where its camera is. For trials: a real robot errs by itself.
struct RobotConfig {
  double position_error = 0.0;  ///< standard deviation along each axis [m]
  double rotation_error = 0.0;  ///< standard deviation of the angle about a random axis through the camera [deg]

  bool exact() const { return position_error == 0.0 && rotation_error == 0.0; }
  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
std::vector<Setting> settings(RobotConfig& config);

/// Where the camera really is, in the frame where the robot believes it: T_believed_true. The first step says where the
/// world is and does not err: what all views had in common would be no error. It depends on the seed and the step
/// alone, so a scan that is taken again after going back errs as it did.
Pose pose_error(const RobotConfig& config, std::uint64_t seed, std::uint32_t step);

}  // namespace nextview

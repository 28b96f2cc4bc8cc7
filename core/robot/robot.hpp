#pragma once
#include <optional>
#include <string>

#include "core/view/pose.hpp"

namespace nextview {

/// What a move costs.
struct MotionCost {
  double distance = 0.0;  ///< path of the camera centre [m]
  double rotation = 0.0;  ///< [rad]
  double seconds = 0.0;
};

/// The paper's robot interface: the planner sees this alone. A driver translates it for one robot.
class Robot {
 public:
  virtual ~Robot() = default;
  /// Why the camera cannot be brought to the pose; nothing if it can.
  virtual std::optional<std::string> unreachable(const Pose& T_world_camera) const = 0;
  virtual MotionCost cost(const Pose& from, const Pose& to) const = 0;
  /// @throws std::runtime_error if the pose cannot be reached; the robot stays where it is.
  virtual void move_to(const Pose& T_world_camera) = 0;
  virtual const Pose& pose() const = 0;
};

/// The ideal free-flying camera: every pose is reachable on a straight line.
class FreeFlyingCamera : public Robot {
 public:
  /// `speed` [m/s] and `turn_rate` [rad/s] give the seconds of a move; the slower of the two counts.
  explicit FreeFlyingCamera(const Pose& start, double speed = 0.25, double turn_rate = 1.0);

  std::optional<std::string> unreachable(const Pose& T_world_camera) const override;
  MotionCost cost(const Pose& from, const Pose& to) const override;
  void move_to(const Pose& T_world_camera) override;
  const Pose& pose() const override { return pose_; }

 private:
  Pose pose_;
  double speed_;
  double turn_rate_;
};

}  // namespace nextview

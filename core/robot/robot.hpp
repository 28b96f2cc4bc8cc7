#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/progress/result.hpp"
#include "core/view/view.hpp"

namespace nextview {

/// What a move costs.
struct MotionCost {
  double distance = 0.0;  ///< path of the camera centre [m]
  double rotation = 0.0;  ///< [rad]
  double seconds = 0.0;
};

/// Whether a view can be reached, and at what cost.
struct Reach {
  std::string unreachable;  ///< why it cannot; empty if it can
  MotionCost cost;
};

/// Why the camera may not be there: it would leave the volume that it must stay in. Empty if it may; no volume:
/// anywhere.
std::string outside(const std::optional<Eigen::AlignedBox3d>& volume, const Vector3& camera);

/// The paper's robot interface: the planner sees this alone. A driver translates it for one robot.
class Robot {
 public:
  virtual ~Robot() = default;
  /// Where the camera is, as the robot knows it: T_world_camera.
  virtual Pose pose() const = 0;
  /// Whether the camera can be brought from a pose to each of the views. One exchange for all of them.
  virtual std::vector<Reach> reach(const Pose& from, std::span<const View> views) = 0;
  /// Moves the camera. Returns the pose that it reached, which counts from then on, or why it did not get there.
  virtual Result<Pose> move_to(const View& view, std::stop_token stop) = 0;
  /// The scan has gone back to when the camera was here: simulated robots go there at no cost, real ones stay.
  virtual void restored(const Pose&) {}
};

/// The ideal free-flying camera: every finite pose (of its volume, if it is given one) is reachable on a straight line,
/// exactly.
class FreeFlyingCamera : public Robot {
 public:
  /// `speed` [m/s] and `turn_rate` [rad/s] give the seconds of a move; the slower of the two counts.
  /// @throws std::invalid_argument if one is not over 0.
  explicit FreeFlyingCamera(const Pose& start, double speed = 0.25, double turn_rate = 1.0);
  /// What lies outside is unreachable from now on.
  void keep_within(const std::optional<Eigen::AlignedBox3d>& volume) { volume_ = volume; }

  Pose pose() const override { return pose_; }
  std::vector<Reach> reach(const Pose& from, std::span<const View> views) override;
  Result<Pose> move_to(const View& view, std::stop_token stop) override;
  void restored(const Pose& T_world_camera) override { pose_ = T_world_camera; }

 private:
  std::string forbidden(const Pose& T_world_camera) const;

  Pose pose_;
  double speed_;
  double turn_rate_;
  std::optional<Eigen::AlignedBox3d> volume_;
};

}  // namespace nextview

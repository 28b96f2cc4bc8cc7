#pragma once
#include "core/robot/robot.hpp"

namespace nextview {

/// Exercise: a robot of its own. It stops short of where it is sent, knows where it really is, does not reach below the
/// table, and, as a real one, is not put back when a scan goes back.
class ShakyRobot : public Robot {
 public:
  static inline const Vector3 error{0.003, -0.002, 0.001};  ///< [m]

  explicit ShakyRobot(const Pose& start) : pose_(start) {}
  Pose pose() const override { return pose_; }
  std::vector<Reach> reach(const Pose& from, std::span<const View> views) override {
    ++exchanges;
    std::vector<Reach> result;
    for (const View& view : views) {
      const Vector3 to = view.T_world_camera.translation();
      const double distance = (to - from.translation()).norm();
      result.push_back({to.z() < -0.5 ? "it is below the table" : "", {distance, 0.0, distance / 0.1}});
    }
    return result;
  }
  Result<Pose> move_to(const View& view, std::stop_token stop) override {
    if (stop.stop_requested()) return Failure{Failure::cancelled, "stopped"};
    if (jammed) return Failure{Failure::unreachable, "the arm is jammed"};
    pose_ = view.T_world_camera;
    pose_.translation() += error;
    return pose_;
  }

  bool jammed = false;
  int exchanges = 0;

 private:
  Pose pose_;
};

}  // namespace nextview

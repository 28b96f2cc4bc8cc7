#pragma once
#include <memory>

#include "core/driver/driver_connection.hpp"
#include "core/robot/robot.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

/// Scans of a live scanner.
class DriverSource : public ScanSource {
 public:
  /// `seed` is told to simulators with each capture.
  DriverSource(std::shared_ptr<DriverConnection> connection, std::uint64_t seed);
  const SourceDescription& describe() const override { return description_; }
  /// The pose that counts is the one that the driver gives with the capture. Far from the view it is a failure, as
  /// that of a move.
  Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token stop) override;

 private:
  std::shared_ptr<DriverConnection> connection_;
  std::uint64_t seed_;
  SourceDescription description_;
};

/// What moves a live scanner, or the person who does.
class DriverRobot : public Robot {
 public:
  /// The camera is taken to be at `start` until the driver says where it is.
  DriverRobot(std::shared_ptr<DriverConnection> connection, const Pose& start);
  Pose pose() const override { return connection_->pose(); }
  /// Views outside the working volume are not asked for.
  /// @throws std::runtime_error with the reason if the driver fails: nothing is known of the views then
  std::vector<Reach> reach(const Pose& from, std::span<const View> views) override;
  /// Real moves are confirmed by the operator first; what a hand moves, or nothing real, is not.
  Result<Pose> move_to(const View& view, std::stop_token stop) override;
  /// A simulated camera is put there at no cost; where its driver is lost, reconnecting does it. Real ones stay.
  void restored(const Pose& T_world_camera) override;

 private:
  std::string forbidden(const Pose& T_world_camera) const;

  std::shared_ptr<DriverConnection> connection_;
};

}  // namespace nextview

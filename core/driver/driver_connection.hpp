#pragma once
#include <functional>
#include <memory>

#include "core/driver/driver_protocol.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

struct DriverOptions {
  std::string command;                                     ///< "PROGRAM ARG…", split as a shell would
  double timeout = 30.0;                                   ///< of each request [s]; 0: for ever
  std::optional<Eigen::AlignedBox3d> working_volume = {};  ///< that the camera centre must not leave [m, world]
  Pose T_flange_camera = Pose::Identity();                 ///< where the driver's poses are those of a flange
  std::filesystem::path folder = {};                       ///< for captures, which go; so does the folder if it is made
  std::function<bool(const Pose& from, const Pose& to)> confirm = {};  ///< of each real move; null: never asked
  std::function<void(const std::string&)> log = {};  ///< hears its standard error by the line, from another thread
  double reached_within = 0.05;                      ///< of the wanted position, or the view was not reached [m]
  double turned_within = 5.0;                        ///< of the wanted orientation, likewise [deg]
  double stop_time = 5.0;                            ///< for a driver to stop in, before it is ended [s]
  double grace = 1.0;                                ///< for a driver to end by itself [s]
};

/// A scanner behind a driver, shared by its robot and its source. One thread at a time.
///
/// What fails says why, and hangs no longer than the time-out. Then the next request may do, and reconnect() does what
/// can be done. A person is waited for only where something is moved or captured: all else has a time-out, whatever
/// the driver says.
class DriverConnection {
 public:
  /// Starts the driver and greets it.
  /// @throws std::invalid_argument for options; std::runtime_error with the reason; Stopped
  explicit DriverConnection(DriverOptions options, std::stop_token stop = {});
  ~DriverConnection();
  DriverConnection(const DriverConnection&) = delete;
  DriverConnection& operator=(const DriverConnection&) = delete;

  const DriverOptions& options() const { return options_; }
  const DriverGreeting& greeting() const { return greeting_; }
  SourceDescription description() const;
  /// Who knows the true object can only be a simulator.
  bool is_simulated() const { return greeting_.can("simulated") || !greeting_.object.empty(); }
  bool is_free_hand() const { return greeting_.can("free-hand"); }

  /// Where the camera is, as far as is known: where the driver last said, else where it was said to be.
  const Pose& pose() const { return pose_; }
  /// Whether the driver has said where the camera is.
  bool knows_pose() const { return knows_pose_; }
  /// Said where the driver itself does not.
  void set_pose(const Pose& T_world_camera) { pose_ = T_world_camera; }

  /// Ends the driver if it still runs, and starts it again. A simulated camera is put where it was. None if all is
  /// well.
  std::optional<Failure> reconnect(std::stop_token stop = {});
  /// Ends the driver: whoever else needs the scanner can have it. reconnect() starts it again.
  void leave();
  /// Whether the last request failed and not by the driver's own decision.
  bool is_lost() const { return lost_; }

  Result<std::vector<Reach>> reach(const Pose& from, std::span<const Pose> poses);
  /// Changes pose(). Nothing is checked or confirmed.
  Result<Pose> move(const Pose& T_world_camera, std::stop_token stop);
  /// Changes pose() to that of the capture.
  Result<Capture> capture(std::uint32_t step, std::uint64_t seed, std::stop_token stop);

 private:
  Result<DriverGreeting> start(const std::stop_token& stop);
  double patience() const;
  double limit() const;
  template <class T>
  Result<T> noted(Result<T> result);
  void stands_at(const Pose& T_world_camera);

  DriverOptions options_;
  std::vector<std::string> words_;
  DriverGreeting greeting_;
  std::unique_ptr<DriverProtocol> protocol_;
  Pose pose_ = Pose::Identity();
  bool knows_pose_ = false, lost_ = false;
  bool made_folder_ = false;  ///< for captures, and not someone else
};

}  // namespace nextview

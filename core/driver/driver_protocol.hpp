#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/driver/driver_answer.hpp"
#include "core/driver/driver_process.hpp"
#include "core/progress/result.hpp"
#include "core/robot/robot.hpp"
#include "core/view/pinhole_camera.hpp"

namespace nextview {

inline constexpr int driver_protocol_version = 1;

/// What a driver says of itself.
struct DriverGreeting {
  std::string name;
  std::vector<std::string> abilities;  ///< "stop", "simulated", "free-hand"; others mean nothing
  PinholeCamera camera;
  double max_range = 1.5;                            ///< [m]
  double range_noise = 0.002;                        ///< standard deviation along the ray [m]
  std::optional<Pose> start = {};                    ///< where the camera is: T_world_camera
  std::optional<Eigen::AlignedBox3d> region = {};    ///< of interest [m, world]
  std::vector<Pose> views = {};                      ///< that it can take, if these are all; empty: any
  std::string object = {};                           ///< file of the true object; simulators only
  std::optional<double> timeout = {};                ///< of a move and a capture [s]; 0: a person is waited for
  std::map<std::string, std::string> settings = {};  ///< object.* and sensor.* of our simulator, by key

  bool can(const std::string& ability) const;
};

/// What a driver says that it captured.
struct CapturedFile {
  Pose T_world_camera;
  std::string file;      ///< relative to the folder of the request
  double scale = 0.0;    ///< of a value of a 16-bit PNG [m]; 0: not said
  std::string measures;  ///< of a 16-bit PNG: "z" or "range"; empty: not said
};

/// What the answers to `hello` and `capture` hold. @throws std::invalid_argument with what is wrong
DriverGreeting greeting_of(const DriverAnswer& answer);
CapturedFile captured_file_of(const DriverAnswer& answer);

/// Our side of the driver protocol, version 1: one JSON object a line.
///
///     {"id": 1, "request": "hello", "protocol": 1}
///     {"id": 1, "ok": true, "protocol": 1, "name": "arm", "abilities": ["stop"], "intrinsics": [fx, fy, cx, cy],
///      "width": 640, "height": 480, "max_range": 1.5, "range_noise": 0.002}
/// (where it is known also: "start": [16 numbers], "region": [6 numbers], "object": "file", "timeout": seconds, and
/// "views": [[16 numbers], …] of a scanner that can take these alone, which are then the candidates; and of our
/// simulator "settings": {"sensor.dropout": "0.1", …}, its own of object.* and sensor.*)
///
///     {"id": 2, "request": "reach", "from": [16 numbers], "poses": [[16 numbers], …]}
///     {"id": 2, "ok": true, "reach": [{"distance": 0.3, "rotation": 0.5, "seconds": 2}, {"unreachable": "why"}]}
///     {"id": 3, "request": "move", "pose": [16 numbers]}           {"id": 3, "ok": true, "pose": [16 numbers]}
///     {"id": 4, "request": "capture", "step": 1, "seed": 1, "folder": "/path"}
///     {"id": 4, "ok": true, "pose": [16 numbers], "file": "scan.npy"}
///     {"id": 5, "request": "stop"}                                 {"id": 4, "error": "stopped"}  {"id": 5, "ok":
///     true}
///     {"id": 6, "request": "bye"}
///
/// What fails leaves the program running, so that the next request may do, unless it has closed its streams, sent a
/// line without an end, or could not be stopped otherwise. A failure names the driver and what was wrong.
class DriverProtocol {
 public:
  /// @param words the program and its arguments @param grace to end by itself [s] @param stop_time to stop in [s]
  /// @throws std::runtime_error if it cannot be started
  DriverProtocol(const std::vector<std::string>& words, std::function<void(const std::string&)> log, double grace,
                 double stop_time);
  ~DriverProtocol();  ///< says bye

  /// How long an answer may take; 0: for ever [s]. A requested stop ends the request.
  struct Wait {
    double seconds = 30.0;
    std::stop_token stop = {};
  };
  Result<DriverGreeting> hello(const Wait& wait);
  Result<std::vector<Reach>> reach(const Pose& from, std::span<const Pose> poses, const Wait& wait);
  /// The pose that was reached. That of a move which was stopped too late to matter comes all the same.
  Result<Pose> move(const Pose& T_world_camera, const Wait& wait);
  Result<CapturedFile> capture(std::uint32_t step, std::uint64_t seed, const std::filesystem::path& folder,
                               const Wait& wait);

  const std::string& name() const { return name_; }
  bool has_ended() const { return process_.has_ended(); }

 private:
  Result<DriverAnswer> ask(const std::string& what, std::string_view with, Failure::Kind on_error, const Wait& wait);
  Result<DriverAnswer> settle(DriverAnswer answer, const std::string& request, Failure::Kind on_error, bool stopping);
  std::optional<Failure> stop_or_end(const std::string& request);
  Failure silent(const std::string& request, double seconds, bool stopping);
  void abandon();
  Failure closed();
  Failure failure(Failure::Kind kind, const std::string& reason) const;

  DriverProcess process_;
  std::string name_;  ///< of the program, until it says its own
  bool can_stop_ = false;
  double stop_time_;  ///< [s]
  std::uint64_t last_id_ = 0;
};

}  // namespace nextview

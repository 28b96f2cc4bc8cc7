#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <stop_token>
#include <variant>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/progress/progress.hpp"
#include "core/progress/result.hpp"
#include "core/sensor/depth_image.hpp"
#include "core/view/view.hpp"

namespace nextview {

/// What a source saw from one view, as it came.
struct Capture {
  std::variant<DepthImage, std::vector<Vector3>> measured;  ///< ranges, or points in the camera frame [m]
  Pose T_world_camera = Pose::Identity();                   ///< as the source believes, not as it was told
  double max_range = 1.5;                                   ///< what is farther off is not seen [m]
};

/// What a source says of itself.
struct SourceDescription {
  PinholeCamera camera;                            ///< views are scored with its rays
  double max_range = 1.5;                          ///< [m]
  double range_noise = 0.002;                      ///< standard deviation along the ray [m]
  std::optional<Pose> start = {};                  ///< where to begin; none: as the configuration says
  std::optional<Eigen::AlignedBox3d> region = {};  ///< region of interest [m, world]; none: the configuration's
  std::vector<View> frames = {};                   ///< if any, these alone can be captured
};

/// Where scans come from: a simulation, a recording, a scanner.
class ScanSource {
 public:
  virtual ~ScanSource() = default;
  virtual const SourceDescription& describe() const = 0;
  /// Takes a scan from where the camera is now; `view` is that pose, as the robot knows it. `step` counts from 1: the
  /// same view of the same step gives a simulation the same noise. A source that knows its pose better says so in the
  /// capture.
  virtual Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token stop) = 0;
};

/// A capture as the map takes it.
struct CapturedScan {
  Scan scan;             ///< its hits cleaned
  std::size_t hits = 0;  ///< before they were cleaned
};

/// Back-projects a capture, and cleans its hits unless `cleaning` is null. Points have no misses.
/// @throws Stopped; std::invalid_argument as clean().
CapturedScan to_scan(const Capture& capture, const CloudConfig* cleaning, const std::stop_token& stop = {});

/// The scans that a source takes from these views, step by step, without a robot. Progress goes from 0 to 1.
/// @throws Stopped; std::runtime_error with the source's reason; std::invalid_argument as clean().
std::vector<Scan> take_scans(ScanSource& source, std::span<const View> views, const CloudConfig* cleaning,
                             const Progress& progress = {}, const std::stop_token& stop = {});

}  // namespace nextview

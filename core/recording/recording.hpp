#pragma once
#include <Eigen/Geometry>
#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "core/cloud/range_scan_folder.hpp"
#include "core/progress/progress.hpp"
#include "core/sensor/depth_image.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// What one frame measured: ranges, or points in the camera frame [m].
using Measured = std::variant<DepthImage, std::vector<Vector3>>;

/// A view that was taken elsewhere. What it measured is read when it is asked for: recordings may be larger than
/// memory.
struct RecordedFrame {
  std::string name;  ///< for people: "frame-000003", "bun045"
  Pose T_world_camera = Pose::Identity();
  std::function<Measured()> read = {};  ///< from any thread; @throws std::runtime_error naming the file and the reason
};

/// Real scans of one object, in the order in which they were recorded.
struct Recording {
  std::string format;                              ///< as dataset.toml names it
  PinholeCamera camera;                            ///< of the images, or the smallest that holds all points' rays
  double max_range = 0.0;                          ///< what is farther off was not seen [m]
  Eigen::AlignedBox3d extent;                      ///< of all measured points [m, world]
  std::optional<Eigen::AlignedBox3d> region = {};  ///< of interest, as the recording itself says [m, world]
  std::vector<RecordedFrame> frames;               ///< at least one
  std::size_t points = 0;                          ///< that all frames measured
  /// Points that are not finite, of all clouds that have been read, each time.
  std::shared_ptr<std::atomic<std::size_t>> left_out = std::make_shared<std::atomic<std::size_t>>(0);
  std::vector<std::string> guessed = {};            ///< what was guessed, a line each, for people
  std::string doubt = {};                           ///< the one of these that says of which unit it likely is
  std::vector<std::filesystem::path> files = {};    ///< that it was read from, frames among them
  std::map<std::string, std::string> follows = {};  ///< from it alone: settings, by key
};

struct RecordingOptions {
  int every = 1;                         ///< takes each n-th frame, the first one among them
  double stand_off = default_stand_off;  ///< of the scanner that took Stanford's range images, which do not tell [m]
};

/// Opens recorded data: a folder of depth images or clouds with poses, of Stanford's range images, OctoMap's scan graph
/// or a scene file. Reads every frame once, for its extent and to find what is damaged before anything is done with it.
/// @throws std::runtime_error, std::invalid_argument with one line that names the file and the reason; Stopped
Recording open_recording(const std::filesystem::path& path, const RecordingOptions& options = {},
                         const Progress& progress = {}, const std::stop_token& stop = {});

}  // namespace nextview

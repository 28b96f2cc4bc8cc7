#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/view/pose.hpp"

namespace nextview {

struct RecordedScan {
  Pose T_world_camera = Pose::Identity();
  std::vector<Vector3> points;  ///< camera frame [m]
};

/// Scans taken elsewhere, and views to be scored on them.
struct RecordedScene {
  std::map<std::string, double> parameters;
  std::vector<RecordedScan> scans;
  std::vector<Pose> views;  ///< T_world_camera
};

/// By its name: .txt, or .txt.gz.
bool is_scene_file(const std::filesystem::path& file);

/// Reads a text, or one compressed with gzip whose name ends in .gz, of lines: `param NAME VALUE`; `scan px py pz qx qy
/// qz qw N`, then N points `x y z` (camera frame, [m]); `view px py pz qx qy qz qw`. Poses are T_world_camera;
/// quaternions within 1e-3 of length 1 are normalised. Empty lines are skipped. Points lie within 1e6 m of the sensor.
/// @throws std::runtime_error with one line "file: reason", or "file:line: reason" for what is wrong inside. What is no
///         regular file is refused.
RecordedScene read_recorded_scene(const std::filesystem::path& file);

}  // namespace nextview

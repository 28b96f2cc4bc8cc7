#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/depth_image_file.hpp"
#include "core/recording/pose_files.hpp"
#include "core/setting/setting.hpp"

namespace nextview {

enum class RecordingFormat { depth_images, clouds, stanford, scan_graph, scene };
enum class CloudUnit { automatic, m, cm, mm };

/// What dataset.toml says of a folder of recorded data.
struct DatasetDescription {
  RecordingFormat format = RecordingFormat::depth_images;
  std::string frames;  ///< pattern, relative to the folder
  std::string poses;   ///< pattern of one file a frame, or one file for all; empty: the clouds' own (PCD's VIEWPOINT)
  PoseFormat poses_format = PoseFormat::matrix4x4;
  PoseDirection pose_direction = PoseDirection::sensor_to_world;
  PoseAxes pose_axes = PoseAxes::optical;
  std::string camera_offset;  ///< where the camera stands in the one that the poses place (optical axes, [m]), as text:
                              ///< x y z or x y z qx qy qz qw; empty: there
  std::string intrinsics;     ///< fx fy cx cy [px], as text
  DepthFormat depth;          ///< width, height, type, offset and depth.*
  std::string mask;           ///< image of pixels to ignore, relative to the folder
  CloudUnit unit = CloudUnit::automatic;
  std::string region;  ///< min x y z, max x y z [m, world], as text; empty: none

  /// @throws std::invalid_argument naming the key and what it takes.
  void validate() const;
  PinholeCamera camera() const;  ///< without a size; fx is 0 if no intrinsics are given
  Pose offset() const;           ///< T_posed_camera
  std::optional<Eigen::AlignedBox3d> region_box() const;
};

/// The keys of dataset.toml.
std::vector<Setting> settings(DatasetDescription& description);

/// @throws std::runtime_error with "FILE:LINE: reason" for what is wrong inside: no TOML, an unknown key (it names the
///         nearest known one), a value that its key does not take.
DatasetDescription read_dataset(const std::filesystem::path& file);

/// As read_dataset takes it; keys that say nothing are left out.
std::string to_toml(const DatasetDescription& description);

/// Names and enumerators, for people and files.
std::string name(RecordingFormat format);

}  // namespace nextview

#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "core/sensor/depth_image.hpp"
#include "core/setting/setting.hpp"

namespace nextview {

/// Points [m, world].
using PointCloud = std::vector<Eigen::Vector3f>;

/// One view's measurement as the map takes it: rays from the camera to where they ended, or to where they were given
/// up.
struct Scan {
  Vector3 origin = Vector3::Zero();  ///< camera centre [m, world]
  PointCloud hits;                   ///< where rays met a surface
  PointCloud misses;                 ///< where rays beyond range were given up (at the maximum range); they carve only
  double max_range = std::numeric_limits<double>::infinity();  ///< longer rays count up to here and end nowhere [m]
};

/// Hits and misses of a depth image; invalid pixels give neither. Points in pixel order. @throws Stopped
Scan back_project(const DepthImage& image, const Pose& T_world_camera, double max_range,
                  const std::stop_token& stop = {});

struct CloudConfig {
  bool outlier_removal = true;      ///< statistical outlier removal of the hits (as PCL's)
  int outlier_neighbours = 16;      ///< neighbours whose mean distance is looked at
  double outlier_deviations = 3.0;  ///< points whose mean distance is this many standard deviations over the average go
  bool down_sampling = false;       ///< voxel-grid down-sampling of the hits (PCL)
  double down_sampling_leaf = 0.002;  ///< [m]

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
std::vector<Setting> settings(CloudConfig& config);

/// The hits after outlier removal and down-sampling, each if switched on. Outlier removal keeps the order;
/// down-sampling puts one centroid a leaf, in the order of the leaves (x fastest).
/// @throws std::invalid_argument if the configuration is not valid, or if the leaf is too small for the cloud's extent
///         (PCL numbers leaves with 32 bits).
/// @throws Stopped
PointCloud clean(const PointCloud& hits, const CloudConfig& config, const std::stop_token& stop = {});

/// Binary little-endian PLY with x y z floats. Written beside the file, then renamed.
/// @throws std::runtime_error naming the file and the reason.
void write_ply(const PointCloud& cloud, const std::filesystem::path& file);

/// Binary PCD (version 0.7, as PCL writes it) with x y z floats. Written beside the file, then renamed.
/// @throws std::runtime_error naming the file and the reason.
void write_pcd(const PointCloud& cloud, const std::filesystem::path& file);

/// What becomes of points that are not finite, as some scanners write where nothing was measured.
enum class NotFinite { refused, kept };

/// The vertices of an ASCII or binary PLY file; other elements and properties are passed over. A file whose name ends
/// in .gz is decompressed first. Header lines that are not known are read on over; `notice`, if given, hears of the
/// first.
/// @throws std::runtime_error with one line that names the file and the reason: missing, not PLY, truncated, claims
///         more than the file holds, no x y z, not finite unless they are kept.
PointCloud read_ply(const std::filesystem::path& file,
                    const std::function<void(const std::string& unknown_line)>& notice = {},
                    NotFinite not_finite = NotFinite::refused);

}  // namespace nextview

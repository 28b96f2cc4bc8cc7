#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

struct ObjectRegionConfig {
  bool remove_planes = true;   ///< the ground, table or walls that an object stands on or before
  double margin = 0.15;        ///< around the object, a share of its longest side
  double range_noise = 0.002;  ///< of the sensor, standard deviation [m]
};

/// A plane behind the object: a table, the ground, a wall.
struct BackgroundPlane {
  Vector3 normal = Vector3::UnitZ();  ///< unit length, towards the object and the cameras
  double offset = 0.0;                ///< normal . p + offset = 0 [m]
  double share = 0.0;                 ///< of the scanned surface
};

/// Where an object of which nothing is known seems to be.
struct ObjectRegion {
  /// Of the points that were kept and what may be behind them (object_box), with the margin [m, world]; empty if there
  /// are none.
  Eigen::AlignedBox3d box;
  PointCloud points;                    ///< of the object
  std::vector<BackgroundPlane> planes;  ///< that were removed
  std::size_t clusters = 0;             ///< what was left without them; the largest is the object
  double spacing = 0.0;                 ///< of the points that were looked at [m]

  /// For people, in one line: what was taken for the object and what was left out.
  std::string text() const;
};

/// Finds the object in its first scans. A plane is behind the object if it is a large part of what was seen, all else
/// lies on the side from which it was seen, and it goes on around the object: the face of a part does not, since the
/// part lies behind it. Of what remains the largest piece is the object. The same for the same input.
/// @throws std::invalid_argument if margin or noise are negative; Stopped
ObjectRegion find_object(std::span<const std::shared_ptr<const Scan>> scans, const ObjectRegionConfig& config = {},
                         const std::stop_token& stop = {});

}  // namespace nextview

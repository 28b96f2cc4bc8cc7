#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// One ray of a depth camera and what it found.
struct RangeMeasurement {
  Eigen::Vector3f end = Eigen::Vector3f::Zero();  ///< where it met a surface, or was given up [m, world]
  std::uint32_t origin = 0;                       ///< of RangeMeasurements::origins
  std::uint32_t weight = 1;                       ///< how many measured rays it stands for
  bool beyond_range = false;                      ///< nothing up to the maximum range
};

/// The rays of one or more scans (z_n, x_n of Eqs. 3-8).
struct RangeMeasurements {
  double max_range = 1.5;  ///< z_max [m]
  std::vector<Vector3> origins;
  std::vector<RangeMeasurement> rays;

  /// Adds the rays of a scan. Hits farther than the maximum range are taken for beyond range. Points on the origin
  /// have no direction and are left out.
  void add(const Scan& scan);
  /// Adds the rays of other measurements of the same maximum range.
  void append(const RangeMeasurements& other);

  /// What was appended to earlier ones. @pre these begin with those
  RangeMeasurements after(const RangeMeasurements& earlier) const;

  /// @throws std::invalid_argument if something is not finite, farther than 1e6 m, or has no origin.
  void validate() const;

  Vector3 direction(const RangeMeasurement& ray) const {
    return (ray.end.cast<double>() - origins[ray.origin]).normalized();
  }
  double range(const RangeMeasurement& ray) const {
    return ray.beyond_range ? max_range : (ray.end.cast<double>() - origins[ray.origin]).norm();
  }
};

/// The rays of scans of one maximum range. @pre !scans.empty()
RangeMeasurements measurements_of(std::span<const Scan> scans);

/// Joins rays of one origin that see the same: that lie in one cell of a grid of directions, `spacing` [rad] wide, and
/// whose ranges are at most `spread` [m] apart (beyond range merges with beyond range). The merged ray has the mean end
/// and the sum of the weights; its likelihood counts that often. Dense images come down to what the voxels can tell
/// apart, at the cost of what differs within a cell. No spacing, no change.
RangeMeasurements merge_rays(const RangeMeasurements& measurements, double spacing, double spread);

/// The same for a map: cells are `spacing` voxel edges wide at the grid's centre, ranges at most `spread` edges apart.
RangeMeasurements merge_rays(const RangeMeasurements& measurements, const VoxelGrid& grid, double spacing,
                             double spread = 1.0);

}  // namespace nextview

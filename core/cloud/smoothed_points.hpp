#pragma once
#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// What noise along the rays asks for where a scan's points are compared with another's.
struct Smoothing {
  double noise = 0.0;        ///< standard deviation of the points along their rays [m]
  double half_window = 0.0;  ///< around a point in the image, at depth 1, along both of its axes

  /// With which six standard deviations are `wanted` [m], or the least that is affordable: the noise of a mean falls
  /// with the root of the number of points, each of which stands for `solid_angle` [sr] of the image.
  static Smoothing down_to(double wanted, double noise, double solid_angle);
  /// What six standard deviations are at least after it [m].
  static double least(double noise);
};

/// The hits, each moved along its ray onto the plane that fits those best that lie around it in the image, as far as
/// they are of the same surface: no more than four times the noise before it or behind it. The number and the order
/// stay. The same on any number of threads.
PointCloud smoothed_points(const Scan& scan, const Pose& T_world_camera, const Smoothing& smoothing);

}  // namespace nextview

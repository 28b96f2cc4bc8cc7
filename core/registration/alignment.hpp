#pragma once
#include <stop_token>

#include "core/cloud/point_cloud.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// Where a cloud lies on a surface.
struct Alignment {
  Pose T_surface_cloud = Pose::Identity();
  double residual = 0.0;  ///< root mean square distance to the surface of the points that lie on it [m]
  double overlap = 0.0;   ///< share of the points that do: within a fiftieth of the surface's longest side
};

/// Moves a cloud rigidly onto the surface that it was measured of, wherever it lies: iterative closest points to planes
/// (Chen and Medioni 1991), from where it is and, if that does not do, from the 24 ways to turn its axes about the
/// middle of its box. Which is best is decided by overlap, then residual. The same for the same input.
/// @throws std::invalid_argument if the cloud has fewer than 100 points; Stopped
Alignment align(const PointCloud& cloud, const TriangleMesh& surface, const std::stop_token& stop = {});

}  // namespace nextview

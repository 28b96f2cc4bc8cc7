#pragma once
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/view/pinhole_camera.hpp"

namespace nextview {

/// What a camera sees, in cells, row by row from the upper left.
struct DepthCells {
  int columns = 0, rows = 0;
  std::vector<float> depth;  ///< along the optical axis [m], the nearest point of each cell; negative: nothing
};

/// What a scan measured, seen from a view.
DepthCells measured_depth(const Scan& scan, const Pose& T_world_camera, const PinholeCamera& camera, int columns,
                          int rows);
/// Small enough for a row of them.
DepthCells thumbnail(const Scan& scan, const Pose& T_world_camera, const PinholeCamera& camera);

}  // namespace nextview

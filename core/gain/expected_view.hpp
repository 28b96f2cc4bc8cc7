#pragma once
#include <cstdint>
#include <vector>

#include "core/gain/map_rays.hpp"

namespace nextview {

/// What a camera is expected to see of a map: one value for each of columns x rows equal cells of its image, row by
/// row.
struct ExpectedView {
  int columns = 0, rows = 0;
  /// Where the ray through the cell's middle enters the voxel that stops it, along the optical axis [m]; negative:
  /// nothing does.
  std::vector<float> depth;
  std::vector<std::uint8_t> unknown;  ///< 1: the ray crossed unmeasured voxels on its way
};

/// Casts the rays of a view in parallel. Of a camera that stands inside of the voxel that stops a ray the depth is 0.
/// @throws std::invalid_argument unless columns and rows are over 0.
ExpectedView expected_view(const MapRays& rays, const Pose& T_world_camera, const PinholeCamera& camera, int columns,
                           int rows);

}  // namespace nextview

#pragma once
#include <cstdint>
#include <vector>

#include "core/gain/ray.hpp"

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

/// Casts the rays of a view in parallel. A ray is stopped by the last voxel that the caster has it visit, if that is
/// measured and has p >= `occupancy_threshold`; `resolution` [m] is the voxel edge of the caster's map. Of a camera
/// that stands inside of the voxel the depth is 0. @throws std::invalid_argument unless columns and rows are over 0.
ExpectedView expected_view(const RayCaster& caster, const Pose& T_world_camera, const PinholeCamera& camera,
                           int columns, int rows, double resolution, double occupancy_threshold);

}  // namespace nextview

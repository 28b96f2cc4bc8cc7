#pragma once
#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy_map.hpp"

namespace nextview {

/// Calls `visit(voxel, is_hit)` for each voxel that OccupancyMap::insert updates with this scan, in the grid's order.
/// @throws Stopped
template <class Visit>
void visit_touched_voxels(const VoxelGrid& grid, const Scan& scan, const std::stop_token& stop, Visit visit) {
  OccupancyMap map(grid, {});  // of this scan alone: the sign of its log-odds tells hits from misses
  map.insert(scan, stop);
  std::uint32_t number = 0;
  for (const Voxel& voxel : map.voxels()) {
    if (voxel.measured) visit(number, voxel.log_odds > 0.0f);
    ++number;
  }
}

}  // namespace nextview

#pragma once
#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy_map.hpp"

namespace nextview {

/// Calls `visit(voxel, is_hit)` for each voxel that OccupancyMap::insert updates with this scan, in the grid's order.
/// @throws Stopped
template <class Visit>
void visit_touched_voxels(const VoxelGrid& grid, const Scan& scan, double max_range, const std::stop_token& stop,
                          Visit visit) {
  OccupancyMap map(grid, {});  // of this scan alone: the sign of its log-odds tells hits from misses
  map.insert(scan, max_range, stop);
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v)
    if (map.voxels()[v].measured) visit(v, map.log_odds()[v] > 0.0f);
}

}  // namespace nextview

#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// A ray of a scan that touches a voxel, as the occupancy map inserts it.
struct VoxelRay {
  Eigen::Vector3f end;       ///< where it ended, or where it was given up [m, world]
  bool hit = false;          ///< it ends in the voxel; otherwise it passes through
  bool met_surface = false;  ///< it ended in some surface; otherwise it was given up at the maximum range
};

/// The rays of a scan that OccupancyMap::insert has touch the voxel, hits first, each kind in the scan's order. Rays
/// longer than the scan's maximum range are cut there and end nowhere. @pre the voxel is one of the grid
std::vector<VoxelRay> rays_through(const VoxelGrid& grid, const Scan& scan, std::uint32_t voxel);

/// What one scan did to a voxel of an occupancy map.
struct VoxelUpdate {
  std::size_t hits = 0;          ///< rays that end in it
  std::size_t misses = 0;        ///< rays that go through it; they count only where there is no hit
  float log_odds_change = 0.0f;  ///< once a scan, a hit outdoing all misses; what the clamps cut off left out
  float log_odds = 0.0f;         ///< afterwards
  float probability = 0.5f;      ///< afterwards
  bool measured() const { return hits + misses > 0; }  ///< by this scan
};

/// How a voxel came by its probability, scan by scan: what an OccupancyMap of this grid and model, empty at first, made
/// of these scans, inserted directly or by way of local maps. The last entry has the map's own bits.
std::vector<VoxelUpdate> voxel_history(const VoxelGrid& grid, const InverseSensorModel& model,
                                       std::span<const std::shared_ptr<const Scan>> scans, std::uint32_t voxel);

}  // namespace nextview

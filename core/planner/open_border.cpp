#include "core/planner/open_border.hpp"

#include <algorithm>

#include "core/map/surface_border.hpp"

namespace nextview {

double open_border(const Knowledge& known) {
  if (!known.scanned) return 0.0;
  const SurfaceBorder border = surface_border(*known.scanned);
  if (border.looked_at == 0) return 0.0;
  const VoxelGrid& grid = known.map.grid();
  const double beyond = std::max(border_reach(*known.scanned), grid.resolution);
  const auto open = std::ranges::count_if(border.points, [&](const SurfaceBorder::Point& point) {
    const Eigen::Vector3i cell = grid.cell_at(point.at.cast<double>() + beyond * point.outward.cast<double>());
    if (!grid.contains(cell)) return false;
    const Voxel voxel = known.planning_voxels().at(cell.x(), cell.y(), cell.z());
    return !voxel.measured || voxel.probability >= known.map.model().occupancy_threshold;
  });
  return double(open) / double(border.looked_at);
}

}  // namespace nextview

#include "core/planner/open_border.hpp"

#include <algorithm>
#include <utility>

#include "core/map/surface_border.hpp"

namespace nextview {

OpenBorder open_border(const Knowledge& known) {
  if (!known.scanned) return {};
  SurfaceBorder border = surface_border(*known.scanned);
  OpenBorder open{{}, border.spacing, std::move(border.within)};
  const VoxelGrid& grid = known.map.grid();
  const double beyond = std::max(border_reach(*known.scanned), grid.resolution);
  const auto may_go_on = [&](const Eigen::Vector3f& at) {
    const Eigen::Vector3i cell = grid.cell_at(at.cast<double>());
    if (!grid.contains(cell)) return false;
    const Voxel voxel = known.planning_voxels().at(cell.x(), cell.y(), cell.z());
    return !voxel.measured || voxel.probability >= known.map.model().occupancy_threshold;
  };
  for (const SurfaceBorder::Point& point : border.points) {
    const Eigen::Vector3f at = point.at + float(beyond) * point.outward;
    if (!may_go_on(at)) continue;
    open.beyond.push_back(at);
    if (may_go_on(at + float(grid.resolution) * point.outward)) open.length += border.spacing;
  }
  return open;
}

}  // namespace nextview

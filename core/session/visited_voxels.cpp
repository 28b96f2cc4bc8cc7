#include "core/session/visited_voxels.hpp"

#include "core/map/traversal.hpp"

namespace nextview {

void mark_visited(const VoxelGrid& grid, const Scan& ideal, std::span<std::uint8_t> visited) {
  const Eigen::Vector3f origin = ideal.origin.cast<float>();
  for (const PointCloud* ends : {&ideal.returns, &ideal.passes})
    for (const Eigen::Vector3f& end : *ends) {
      const auto mark = [&](int x, int y, int z) {
        if (grid.contains({x, y, z})) visited[grid.index({x, y, z})] = 1;
        return true;
      };
      walk_segment(grid, origin, end, mark);
      const Eigen::Vector3i last = grid.cell_at(end.cast<double>());
      mark(last.x(), last.y(), last.z());
    }
}

}  // namespace nextview

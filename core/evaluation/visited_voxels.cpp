#include "core/evaluation/visited_voxels.hpp"

#include <limits>

#include "core/map/ray_marks.hpp"

namespace nextview {

void mark_visited(const VoxelGrid& grid, const Scan& ideal, BitMask& visited, const std::stop_token& stop) {
  RayMarks marks(grid);
  for (const PointCloud* ends : {&ideal.hits, &ideal.misses})
    marks.pass(ideal.origin.cast<float>(), *ends, std::numeric_limits<double>::infinity(), stop);
  for (const PointCloud* ends : {&ideal.hits, &ideal.misses})
    for (const Eigen::Vector3f& end : *ends) {
      const Eigen::Vector3i last = grid.cell_at(end.cast<double>());
      if (grid.contains(last)) marks.set(last, 1);
    }
  const auto row = [&](std::size_t number) {
    const int y = int(number % std::size_t(grid.size.y())), z = int(number / std::size_t(grid.size.y()));
    return marks.row({0, y, z});
  };
  visited.add_rows(std::size_t(grid.size.x()), row);
}

}  // namespace nextview

#include "core/evaluation/visited_voxels.hpp"

#include <limits>

#include "core/map/ray_marks.hpp"

namespace nextview {

void mark_visited(const VoxelGrid& grid, const Scan& ideal, BitMask& visited, const std::stop_token& stop) {
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  const Eigen::Vector3f origin = ideal.origin.cast<float>();
  RayMarks marks(grid);
  for (const PointCloud* ends : {&ideal.hits, &ideal.misses}) marks.pass(origin, *ends, no_limit, stop);
  for (const PointCloud* ends : {&ideal.hits, &ideal.misses}) marks.mark_ends(origin, *ends, no_limit, 1);
  const auto row = [&](std::size_t number) {
    const int y = int(number % std::size_t(grid.size.y())), z = int(number / std::size_t(grid.size.y()));
    return marks.row({0, y, z});
  };
  visited.add_rows(std::size_t(grid.size.x()), row);
}

}  // namespace nextview

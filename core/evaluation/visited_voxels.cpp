#include "core/evaluation/visited_voxels.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <limits>

#include "core/map/ray_marks.hpp"

namespace nextview {

void mark_visited(const VoxelGrid& grid, const Scan& ideal, std::span<std::uint8_t> visited,
                  const std::stop_token& stop) {
  RayMarks marks(grid);
  for (const PointCloud* ends : {&ideal.hits, &ideal.misses})
    marks.pass(ideal.origin.cast<float>(), *ends, std::numeric_limits<double>::infinity(), stop);
  for (const PointCloud* ends : {&ideal.hits, &ideal.misses})
    for (const Eigen::Vector3f& end : *ends) {
      const Eigen::Vector3i last = grid.cell_at(end.cast<double>());
      if (grid.contains(last)) marks.set(last, 1);
    }
  tbb::parallel_for(0, grid.size.z(), [&](int z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      const std::uint8_t* const of_row = marks.row(0, y, z);
      std::uint8_t* const row = &visited[grid.index({0, y, z})];
      for (int x = 0; x < grid.size.x(); ++x) row[x] |= of_row[x];
    }
  });
}

}  // namespace nextview

#include "core/evaluation/visited_voxels.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "core/map/traversal.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {

void mark_visited(const VoxelGrid& grid, const Scan& ideal, std::span<std::uint8_t> visited,
                  const std::stop_token& stop) {
  const Eigen::Vector3f origin = ideal.origin.cast<float>();
  const auto mark = [&](int x, int y, int z) {  // several rays may visit a voxel; they all write the same
    std::atomic_ref(visited[grid.index({x, y, z})]).store(1, std::memory_order_relaxed);
    return true;
  };
  for (const PointCloud* ends : {&ideal.hits, &ideal.misses})
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ends->size(), 1024), [&](const auto& range) {
      if (stop.stop_requested()) return;
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const Eigen::Vector3f& end = (*ends)[i];
        walk_segment_inside(grid, origin, end, mark);
        const Eigen::Vector3i last = grid.cell_at(end.cast<double>());
        if (grid.contains(last)) mark(last.x(), last.y(), last.z());
      }
    });
  throw_if_stopped(stop);
}

}  // namespace nextview

#pragma once
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/Ray.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <functional>

#include "tests/benchmarks/planning_step.hpp"

namespace nextview {

// Others' maps are read voxel by voxel. `reader()` makes what says how probably a voxel (x, y, z of the lattice) is
// occupied, 0.5 where nobody has measured: one a view, as most remember where they looked last.

/// The best candidate's occlusion-aware score: rays are walked by NanoVDB's DDA, views on all threads.
template <class Reader>
double best_score(const PlanningStep& step, const Reader& reader) {
  using Walked = nanovdb::Ray<double>;
  const double resolution = step.map.grid().resolution, reach = PlanningStep::max_range / resolution;
  const auto score_view = [&](const Pose& view) {
    auto probability = reader();
    const Vector3 o = view.translation() / resolution;
    double sum = 0.0;
    for (const Vector3& direction : step.bundle.directions) {
      const Vector3 d = view.linear() * direction;
      const Walked ray({o.x(), o.y(), o.z()}, {d.x(), d.y(), d.z()}, 0.0, reach);
      nanovdb::DDA<Walked> walk(ray);
      double visibility = 1.0;
      do {
        const nanovdb::Coord at = walk.voxel();
        const double p = probability(at.x(), at.y(), at.z());
        sum += visibility * entropy(p);
        visibility *= 1.0 - p;
        if (p > 0.5) break;
      } while (walk.step());
    }
    return sum;
  };
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, step.candidates.size(), 1), 0.0,
      [&](const auto& range, double best) {
        for (std::size_t v = range.begin(); v != range.end(); ++v)
          best = std::max(best, score_view(step.candidates[v]));
        return best;
      },
      [](double a, double b) { return std::max(a, b); });
}

/// Voxels of the grid that a map calls occupied.
template <class Reader>
std::size_t occupied_voxels(const VoxelGrid& grid, const Reader& reader) {
  auto probability = reader();
  std::size_t count = 0;
  for (std::uint32_t index = 0; index < grid.voxel_count(); ++index) {
    const Eigen::Vector3i at = grid.first + grid.cell(index);
    count += probability(at.x(), at.y(), at.z()) > 0.5;
  }
  return count;
}

}  // namespace nextview

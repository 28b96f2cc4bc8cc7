#include "core/gibbs/independence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nextview {

double rays_per_hit_cell(const RangeMeasurements& measurements, const VoxelGrid& grid) {
  RangeMeasurements hits{measurements.max_range, measurements.origins, {}};
  double rays = 0.0;
  for (const RangeMeasurement& ray : measurements.rays) {
    if (ray.beyond_range || !grid.contains(grid.cell_at(ray.end.cast<double>()))) continue;
    hits.rays.push_back(ray);
    rays += ray.weight;
  }
  constexpr double any_range = std::numeric_limits<double>::infinity();
  const std::size_t cells = merge_rays(hits, grid, 1.0, any_range).rays.size();
  return cells == 0 ? 1.0 : std::max(1.0, rays / static_cast<double>(cells));
}

double independence_at(double rays_per_hit_cell) { return std::min(1.0, 2.0 / rays_per_hit_cell); }

ForwardSensorModel with_independence(ForwardSensorModel model, const RangeMeasurements& measurements,
                                     const VoxelGrid& grid) {
  if (model.independence > 0.0) return model;
  model.independence =
      model.kind == ForwardModel::attenuation ? independence_at(rays_per_hit_cell(measurements, grid)) : 1.0;
  return model;
}

}  // namespace nextview

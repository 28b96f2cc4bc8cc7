#include "core/gibbs/independence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nextview {

double HitCells::rays_per_cell() const { return cells == 0 ? 1.0 : std::max(1.0, rays / static_cast<double>(cells)); }

HitCells hit_cells(const RangeMeasurements& measurements, const VoxelGrid& grid) {
  RangeMeasurements hits{measurements.max_range, measurements.origins, {}};
  double rays = 0.0;
  for (const RangeMeasurement& ray : measurements.rays) {
    if (ray.beyond_range || !grid.contains(grid.cell_at(ray.end.cast<double>()))) continue;
    hits.rays.push_back(ray);
    rays += ray.weight;
  }
  constexpr double any_range = std::numeric_limits<double>::infinity();
  return {rays, merge_rays(hits, grid, 1.0, any_range).rays.size()};
}

double independence_at(double rays_per_hit_cell) { return std::min(1.0, 2.0 / rays_per_hit_cell); }

bool independence_follows_from_hits(const ForwardSensorModel& model) {
  return !(model.independence > 0.0) && model.kind == ForwardModel::attenuation;
}

ForwardSensorModel with_independence(ForwardSensorModel model, const HitCells& hits) {
  if (independence_follows_from_hits(model))
    model.independence = independence_at(hits.rays_per_cell());
  else if (!(model.independence > 0.0))
    model.independence = 1.0;
  return model;
}

ForwardSensorModel with_independence(ForwardSensorModel model, const RangeMeasurements& measurements,
                                     const VoxelGrid& grid) {
  const HitCells hits = independence_follows_from_hits(model) ? hit_cells(measurements, grid) : HitCells();
  return with_independence(std::move(model), hits);
}

}  // namespace nextview

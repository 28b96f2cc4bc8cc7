#include "core/gibbs/full_conditional.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/gibbs/independence.hpp"

namespace nextview {
namespace {

/// Whether the straight line from the camera through a ray's end meets the ball around a voxel.
bool may_touch(const RangeMeasurements& measurements, const RangeMeasurement& ray, const Vector3& centre,
               double radius) {
  const Vector3 to_centre = centre - measurements.origins[ray.origin];
  const Vector3 along = ray.end.cast<double>() - measurements.origins[ray.origin];
  const double around = to_centre.squaredNorm() - radius * radius;  // at most 0: the camera is in the ball
  const double forward = along.dot(to_centre);
  return around <= 0.0 || (forward > 0.0 && forward * forward >= around * along.squaredNorm());
}

/// The rays that depend on a voxel, and where they cross it.
std::vector<RayEvidence> crossing_rays(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                       const ForwardSensorModel& model, std::uint32_t voxel) {
  const Vector3 centre = grid.centre(voxel);
  const double radius = 0.501 * std::numbers::sqrt3 * grid.resolution;
  std::vector<RayEvidence> rays;
  for (std::uint32_t n = 0; n < measurements.rays.size(); ++n) {
    if (!may_touch(measurements, measurements.rays[n], centre, radius)) continue;
    for (const VoxelSegment& s : ray_segments(grid, measurements, measurements.rays[n], model))
      if (s.voxel == voxel) rays.push_back({n, s.enter, s.exit});
  }
  return rays;
}

/// weight log p(z | m, level) of each ray, per level: [level][ray].
std::vector<std::vector<double>> log_likelihoods(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                                 const ForwardSensorModel& model, std::span<const RayEvidence> rays,
                                                 std::vector<std::uint8_t> map, std::uint32_t voxel) {
  std::vector<std::vector<double>> terms(model.levels(), std::vector<double>(rays.size()));
  for (int level = 0; level < model.levels(); ++level) {
    map[voxel] = static_cast<std::uint8_t>(level);
    tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t k) {
      const RangeMeasurement& ray = measurements.rays[rays[k].ray];
      terms[level][k] = ray.weight * model.independence * log_likelihood(grid, model, measurements, ray, map);
    });
  }
  return terms;
}

/// Probabilities that have these log-odds to the first.
std::vector<double> normalised(std::span<const double> log_odds) {
  const double largest = *std::max_element(log_odds.begin(), log_odds.end());
  std::vector<double> probability;
  double sum = 0.0;
  for (const double l : log_odds) sum += probability.emplace_back(std::exp(l - largest));
  for (double& p : probability) p /= sum;
  return probability;
}

void require_same_grid(const VoxelGrid& grid, const ForwardSensorModel& model, std::span<const std::uint8_t> levels,
                       std::uint32_t voxel) {
  if (levels.size() != grid.voxel_count() || voxel >= levels.size() ||
      *std::max_element(levels.begin(), levels.end()) >= model.levels())
    throw std::invalid_argument("gibbs: the map or the voxel is of another grid or model");
}

}  // namespace

FullConditional full_conditional(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                 const ForwardSensorModel& configured, double prior,
                                 std::span<const std::uint8_t> levels, std::uint32_t voxel) {
  configured.validate();
  if (!(prior > 0.0 && prior < 1.0))
    throw std::invalid_argument(fmt::format("gibbs: prior must be between 0 and 1, not {}", prior));
  require_same_grid(grid, configured, levels, voxel);
  const ForwardSensorModel model = with_independence(configured, measurements, grid);
  FullConditional conditional;
  conditional.log_prior_odds = std::log(prior / (model.levels() - 1) / (1.0 - prior));
  conditional.rays = crossing_rays(grid, measurements, model, voxel);
  const auto terms =
      log_likelihoods(grid, measurements, model, conditional.rays, {levels.begin(), levels.end()}, voxel);
  std::vector<double> log_odds(model.levels(), conditional.log_prior_odds);
  log_odds[0] = 0.0;
  for (int q = 1; q < model.levels(); ++q)
    for (std::size_t k = 0; k < conditional.rays.size(); ++k) log_odds[q] += terms[q][k] - terms[0][k];  // Eq. 8
  conditional.level = static_cast<int>(std::max_element(log_odds.begin() + 1, log_odds.end()) - log_odds.begin());
  for (std::size_t k = 0; k < conditional.rays.size(); ++k)
    conditional.rays[k].log_ratio = terms[conditional.level][k] - terms[0][k];
  conditional.probability = normalised(log_odds);  // Eq. 9
  return conditional;
}

}  // namespace nextview

#include "core/gibbs/exact_posterior.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "core/gibbs/independence.hpp"

namespace nextview {
namespace {

/// Adds, for one map, how many measured rays reach each voxel, times the map's share.
void add_reach(const VoxelGrid& grid, const ForwardSensorModel& model, const RangeMeasurements& measurements,
               const std::vector<std::vector<VoxelSegment>>& segments, const std::vector<std::uint8_t>& map,
               double share, std::vector<double>& reach) {
  for (std::size_t n = 0; n < segments.size(); ++n) {
    double survival = share * measurements.rays[n].weight;
    for (const VoxelSegment& s : segments[n]) {
      reach[s.voxel] += survival;
      survival *= model.transmission(map[s.voxel], (s.exit - s.enter) / grid.resolution);
    }
  }
}

/// The next map: a number of `levels` digits, one per voxel. False after the last.
bool advance(std::vector<std::uint8_t>& map, int levels) {
  for (std::uint8_t& level : map) {
    if (++level < levels) return true;
    level = 0;
  }
  return false;
}

}  // namespace

ExactPosterior exact_posterior(const VoxelGrid& grid, const RangeMeasurements& measurements,
                               const ForwardSensorModel& configured, double prior) {
  configured.validate();
  measurements.validate();
  if (!(prior > 0.0 && prior < 1.0))
    throw std::invalid_argument(fmt::format("gibbs: prior must be between 0 and 1, not {}", prior));
  const std::size_t voxels = grid.voxel_count();
  if (static_cast<double>(voxels) * std::log2(configured.levels()) > 20.0)
    throw std::invalid_argument(fmt::format("{} voxels of {} levels make {}^{} maps; at most 2^20 are enumerated",
                                            voxels, configured.levels(), configured.levels(), voxels));

  const ForwardSensorModel model = with_independence(configured, measurements, grid);
  std::vector<std::vector<VoxelSegment>> segments;
  for (const RangeMeasurement& ray : measurements.rays)
    segments.push_back(ray_segments(grid, measurements, ray, model));
  const double log_free = std::log1p(-prior), log_level = std::log(prior / (model.levels() - 1));
  const auto log_joint = [&](const std::vector<std::uint8_t>& map) {
    double sum = 0.0;
    for (const std::uint8_t level : map) sum += level ? log_level : log_free;
    for (const RangeMeasurement& ray : measurements.rays)
      sum += ray.weight * model.independence * log_likelihood(grid, model, measurements, ray, map);
    return sum;
  };

  // Two passes: the largest term first, so that the sum neither overflows nor vanishes.
  std::vector<double> terms;
  std::vector<std::uint8_t> map(voxels, 0);
  double largest = -std::numeric_limits<double>::infinity();
  do {
    terms.push_back(log_joint(map));
    largest = std::max(largest, terms.back());
  } while (advance(map, model.levels()));
  double evidence = 0.0;
  for (double& term : terms) evidence += term = std::exp(term - largest);

  ExactPosterior posterior{std::vector<double>(voxels), std::vector<double>(voxels), std::vector<double>(voxels),
                           largest + std::log(evidence)};
  std::size_t number = 0;
  do {
    const double share = terms[number++] / evidence;  // Eq. 3
    for (std::size_t i = 0; i < voxels; ++i) {        // Eq. 4
      posterior.occupied[i] += map[i] > 0 ? share : 0.0;
      posterior.upper[i] += map[i] == model.levels() - 1 ? share : 0.0;
    }
    add_reach(grid, model, measurements, segments, map, share, posterior.reach);
  } while (advance(map, model.levels()));
  return posterior;
}

}  // namespace nextview

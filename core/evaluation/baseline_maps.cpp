#include "core/evaluation/baseline_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/evaluation/touched_voxels.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/map/traversal.hpp"

namespace nextview {
namespace {

// Of the hit ratio.
constexpr double pseudo_hits = 0.05, pseudo_rays = 0.1;

// Of the Beta-binomial.
constexpr double prior_occupied = 0.05;
constexpr double stop_alpha = 1, stop_beta = 2;      ///< of the share of rays that an occupied voxel stops
constexpr double false_alpha = 1, false_beta = 999;  ///< of the share of rays that a free voxel stops (false hits)

enum class Touch : bool { miss, hit };

/// Calls `visit(voxel, touch)` for each voxel that a ray passes or ends in, ray after ray, along each in order.
template <class Visit>
void visit_rays(const VoxelGrid& grid, const Scan& scan, Visit visit) {
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  const auto carve = [&](const Eigen::Vector3f& end) {
    bool inside = false;
    walk_segment(grid, origin, end, [&](int x, int y, int z) {
      if (!grid.contains({x, y, z})) return !inside;  // the region is convex: a ray that left it is done
      inside = true;
      visit(grid.index({x, y, z}), Touch::miss);
      return true;
    });
  };
  for (const auto* ends : {&scan.hits, &scan.misses})
    for (const Eigen::Vector3f& point : *ends) {
      const bool in_range = ray_length(origin, point) <= scan.max_range;
      carve(in_range ? point : point_on_ray(origin, point, scan.max_range));
      const Eigen::Vector3i cell = grid.cell_at(point.cast<double>());
      if (ends == &scan.hits && in_range && grid.contains(cell)) visit(grid.index(cell), Touch::hit);
    }
}

double log_beta(double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); }

}  // namespace

double hit_ratio(const RayCounts& counts) {
  const double hits = counts.hits, rays = hits + counts.misses;
  return (hits + pseudo_hits) / (rays + pseudo_rays);
}

double beta_binomial(const RayCounts& counts) {
  const double hits = counts.hits, misses = counts.misses;
  // Integrated over the share q of rays that the voxel stops: q^hits (1-q)^misses Beta(q; alpha, beta).
  const auto log_likelihood = [&](double alpha, double beta) {
    return log_beta(alpha + hits, beta + misses) - log_beta(alpha, beta);
  };
  const double log_if_occupied = log_likelihood(stop_alpha, stop_beta);
  const double log_if_free = log_likelihood(false_alpha, false_beta);
  return probability(log_odds(prior_occupied) + log_if_occupied - log_if_free);
}

BaselineMaps::BaselineMaps(const VoxelGrid& grid, std::span<const Scan> scans, const InverseSensorModel& model)
    : grid_(grid), scans_(scans), model_(model), counts_(grid.voxel_count()) {
  model.validate();
  for (const Scan& scan : scans)
    if (!(scan.max_range > 0.0))
      throw std::invalid_argument(fmt::format("baseline maps: max_range must be over 0 m, not {}", scan.max_range));
  count_rays();
}

void BaselineMaps::count_rays() {
  constexpr std::uint8_t missed = 1, hit = 2;
  std::vector<std::uint8_t> touched(counts_.size());  // by the rays of one scan
  for (const Scan& scan : scans_) {
    visit_rays(grid_, scan, [&](std::uint32_t voxel, Touch touch) {
      ++(touch == Touch::hit ? counts_[voxel].hits : counts_[voxel].misses);
      touched[voxel] |= touch == Touch::hit ? hit : missed;
    });
    for (std::size_t v = 0; v < touched.size(); ++v) {
      counts_[v].scan_hits += (touched[v] & hit) != 0;
      counts_[v].scan_misses += touched[v] == missed;
      touched[v] = 0;
    }
  }
}

std::vector<Voxel> BaselineMaps::make(BaselineMap map) const {
  switch (map) {
    case BaselineMap::octomap:
      return octomap();
    case BaselineMap::per_ray:
      return per_ray();
    case BaselineMap::no_clamps:
      return no_clamps();
    case BaselineMap::hit_ratio:
      return visited_voxels([&](std::size_t v) { return hit_ratio(counts_[v]); });
    case BaselineMap::beta_binomial:
      return visited_voxels([&](std::size_t v) { return beta_binomial(counts_[v]); });
  }
  throw std::invalid_argument(fmt::format("baseline maps: there is no map {}", static_cast<int>(map)));
}

template <class Probability>
std::vector<Voxel> BaselineMaps::visited_voxels(Probability p_of) const {
  std::vector<Voxel> voxels(counts_.size());
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    if (!counts_[v].any()) continue;
    const double p = p_of(v);
    voxels[v] = {static_cast<float>(p), static_cast<float>(entropy(p)), model_.classify(p), true};
  }
  return voxels;
}

std::vector<Voxel> BaselineMaps::octomap() const {
  OccupancyMap map(grid_, model_);
  for (const Scan& scan : scans_) map.insert(scan);
  return map.voxels().dense();
}

double BaselineMaps::update_term(const Scan& scan, std::uint32_t voxel, bool is_hit) const {
  const double range = (grid_.centre(voxel) - scan.origin).norm();
  return is_hit ? model_.hit_term(range) : model_.miss_term(range);
}

std::vector<Voxel> BaselineMaps::per_ray() const {
  const double hit = model_.hit_term(1.0), miss = model_.miss_term(1.0);
  const double lowest = log_odds(model_.clamp_min), highest = log_odds(model_.clamp_max);
  std::vector<double> sums(counts_.size());
  for (const Scan& scan : scans_)
    visit_rays(grid_, scan, [&](std::uint32_t voxel, Touch touch) {
      double term = touch == Touch::hit ? hit : miss;
      if (model_.range_dependent()) term = update_term(scan, voxel, touch == Touch::hit);
      sums[voxel] = std::clamp(sums[voxel] + term, lowest, highest);
    });
  return visited_voxels([&](std::size_t v) { return probability(sums[v]); });
}

std::vector<Voxel> BaselineMaps::no_clamps() const {
  std::vector<double> sums(counts_.size());
  if (model_.range_dependent()) {
    for (const Scan& scan : scans_)
      visit_touched_voxels(grid_, scan, {},
                           [&](std::uint32_t voxel, bool is_hit) { sums[voxel] += update_term(scan, voxel, is_hit); });
  } else {
    const double hit = model_.hit_term(1.0), miss = model_.miss_term(1.0);
    for (std::size_t v = 0; v < sums.size(); ++v) sums[v] = counts_[v].scan_hits * hit + counts_[v].scan_misses * miss;
  }
  return visited_voxels([&](std::size_t v) { return probability(sums[v]); });
}

}  // namespace nextview

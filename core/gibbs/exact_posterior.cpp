#include "core/gibbs/exact_posterior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/gibbs/independence.hpp"

namespace nextview {
namespace {

using Levels = std::vector<std::uint8_t>;  // one entry a voxel of the grid

/// What one ray says, of every combination of the levels of the voxels on it: few, where the ray crosses few voxels.
/// Combinations are numbered in base `levels`, the first voxel of the ray lowest.
struct RayTable {
  std::vector<VoxelSegment> segments;
  double weight = 0.0;                 ///< rays that it stands for
  std::vector<double> log_likelihood;  ///< of each combination; weight and independence counted
  std::vector<double> share;           ///< P(combination | z), once maps are enumerated

  std::size_t combination(const Levels& map, std::size_t levels) const {
    std::size_t number = 0;
    for (std::size_t k = segments.size(); k-- > 0;) number = number * levels + map[segments[k].voxel];
    return number;
  }
};

/// All maps, voxel by voxel: what a ray says is added as soon as its last voxel has a level.
class Enumeration {
 public:
  Enumeration(const VoxelGrid& grid, const RangeMeasurements& measurements, const ForwardSensorModel& model,
              double prior)
      : grid_(grid),
        model_(model),
        levels_(std::size_t(model.levels())),
        map_(grid.voxel_count()),
        log_prior_(levels_, std::log(prior / double(levels_ - 1))),
        ending_(grid.voxel_count()) {
    log_prior_[0] = std::log1p(-prior);
    for (const RangeMeasurement& ray : measurements.rays) tables_.push_back(table_of(measurements, ray));
    for (RayTable& table : tables_) {
      if (table.segments.empty()) {
        log_of_no_voxel_ += table.log_likelihood.front();
        continue;
      }
      const auto last = std::ranges::max(table.segments, {}, &VoxelSegment::voxel).voxel;
      ending_[last].push_back(&table);
    }
  }

  ExactPosterior posterior() {
    largest_ = largest_below(0, log_of_no_voxel_);
    const std::vector<double> none(map_.size());
    ExactPosterior result{none, none, none, 0.0};
    const double evidence = add_below(0, log_of_no_voxel_, result);
    for (double& sum : result.occupied) sum /= evidence;
    for (double& sum : result.upper) sum /= evidence;
    for (RayTable& table : tables_) add_reach(table, evidence, result.reach);
    result.log_evidence = largest_ + std::log(evidence);
    return result;
  }

 private:
  RayTable table_of(const RangeMeasurements& measurements, const RangeMeasurement& ray) const {
    RayTable table{ray_segments(grid_, measurements, ray, model_), double(ray.weight), {}, {}};
    Levels map(map_.size());
    std::size_t combinations = 1;
    for (std::size_t k = 0; k < table.segments.size(); ++k) combinations *= levels_;
    for (std::size_t number = 0; number < combinations; ++number) {
      std::size_t rest = number;
      for (const VoxelSegment& s : table.segments) map[s.voxel] = std::uint8_t(rest % levels_), rest /= levels_;
      table.log_likelihood.push_back(ray.weight * model_.independence *
                                     log_likelihood(grid_, model_, measurements, ray, table.segments, map));
    }
    table.share.resize(combinations);
    return table;
  }

  /// What giving the voxel its level adds to the log of the joint probability.
  double log_term(std::size_t voxel) const {
    double sum = log_prior_[map_[voxel]];
    for (const RayTable* table : ending_[voxel]) sum += table->log_likelihood[table->combination(map_, levels_)];
    return sum;
  }

  /// The largest log of the joint probability of the maps whose first `voxel` voxels are those of map_: with it, their
  /// sum neither overflows nor vanishes.
  double largest_below(std::size_t voxel, double log_joint) {
    if (voxel == map_.size()) return log_joint;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t level = 0; level < levels_; ++level) {
      map_[voxel] = std::uint8_t(level);
      largest = std::max(largest, largest_below(voxel + 1, log_joint + log_term(voxel)));
    }
    return largest;
  }

  /// The joint probability of all those maps together (Eq. 3), which is added to whatever they have in common (Eq. 4).
  double add_below(std::size_t voxel, double log_joint, ExactPosterior& sums) {
    if (voxel == map_.size()) return std::exp(log_joint - largest_);
    double all = 0.0;
    for (std::size_t level = 0; level < levels_; ++level) {
      map_[voxel] = std::uint8_t(level);
      const double of_level = add_below(voxel + 1, log_joint + log_term(voxel), sums);
      map_[voxel] = std::uint8_t(level);
      for (RayTable* table : ending_[voxel]) table->share[table->combination(map_, levels_)] += of_level;
      if (level > 0) sums.occupied[voxel] += of_level;
      if (level == levels_ - 1) sums.upper[voxel] += of_level;
      all += of_level;
    }
    return all;
  }

  /// How many of a measured ray reach each voxel on it.
  void add_reach(const RayTable& table, double evidence, std::vector<double>& reach) const {
    if (table.segments.empty()) return;
    for (std::size_t number = 0; number < table.share.size(); ++number) {
      double survival = table.share[number] / evidence * table.weight;
      std::size_t rest = number;
      for (const VoxelSegment& s : table.segments) {
        reach[s.voxel] += survival;
        survival *= model_.transmission(int(rest % levels_), (s.exit - s.enter) / grid_.resolution);
        rest /= levels_;
      }
    }
  }

  const VoxelGrid& grid_;
  const ForwardSensorModel& model_;
  std::size_t levels_;
  Levels map_;
  std::vector<double> log_prior_;  // of a voxel, by its level
  std::vector<RayTable> tables_;
  std::vector<std::vector<RayTable*>> ending_;  // by voxel: rays whose voxels have no higher number
  double log_of_no_voxel_ = 0.0;                // rays that pass the grid by
  double largest_ = 0.0;
};

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
  return Enumeration(grid, measurements, model, prior).posterior();
}

}  // namespace nextview

#include "core/gibbs/exact_posterior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "core/gibbs/independence.hpp"

namespace nextview {
namespace {

using Levels = std::vector<std::uint8_t>;  // one entry a voxel of the grid

struct Ray {
  std::vector<VoxelSegment> segments;
  double weight = 0.0;  ///< measured rays that it stands for
};

/// What the rays through the same voxels say, of every combination of these voxels' levels: few, where they are few.
/// Combinations are numbered in base `levels`, the first voxel lowest.
struct RayTable {
  std::vector<Ray> rays;
  std::vector<double> log_likelihood;  ///< of each combination, all rays together; weight and independence counted
  std::vector<double> share;           ///< P(combination | z), once maps are enumerated

  const std::vector<VoxelSegment>& voxels() const { return rays.front().segments; }
  std::size_t combination(const Levels& map, std::size_t levels) const {
    std::size_t number = 0;
    for (std::size_t k = voxels().size(); k-- > 0;) number = number * levels + map[voxels()[k].voxel];
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
    for (const RangeMeasurement& ray : measurements.rays) tabulate(measurements, ray);
    for (auto& [voxels, table] : tables_) {
      if (voxels.empty())
        log_of_no_voxel_ = table.log_likelihood.front();
      else
        ending_[std::ranges::max(voxels)].push_back(&table);
    }
  }

  ExactPosterior posterior() {
    largest_ = largest_below(0, log_of_no_voxel_);
    const std::vector<double> none(map_.size());
    ExactPosterior result{none, none, none, 0.0};
    const double evidence = add_below(0, log_of_no_voxel_, result);
    for (double& sum : result.occupied) sum /= evidence;
    for (double& sum : result.upper) sum /= evidence;
    for (const auto& [voxels, table] : tables_)
      for (const Ray& ray : table.rays) add_reach(ray, table.share, evidence, result.reach);
    result.log_evidence = largest_ + std::log(evidence);
    return result;
  }

 private:
  /// Takes the next voxel's level off the number of a combination, in the order in which combination() put them there.
  std::uint8_t next_level(std::size_t& rest) const {
    const std::size_t level = rest % levels_;
    rest /= levels_;
    return std::uint8_t(level);
  }

  void tabulate(const RangeMeasurements& measurements, const RangeMeasurement& measured) {
    const Ray ray{ray_segments(grid_, measurements, measured, model_), double(measured.weight)};
    std::vector<std::uint32_t> voxels;
    std::size_t combinations = 1;
    for (const VoxelSegment& s : ray.segments) voxels.push_back(s.voxel), combinations *= levels_;
    RayTable& table = tables_[voxels];
    table.log_likelihood.resize(combinations);
    table.share.resize(combinations);
    table.rays.push_back(ray);
    Levels map(map_.size());
    for (std::size_t number = 0; number < combinations; ++number) {
      std::size_t rest = number;
      for (const std::uint32_t voxel : voxels) map[voxel] = next_level(rest);
      table.log_likelihood[number] +=
          ray.weight * model_.independence * log_likelihood(grid_, model_, measurements, measured, ray.segments, map);
    }
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
      for (RayTable* table : ending_[voxel]) table->share[table->combination(map_, levels_)] += of_level;
      if (level > 0) sums.occupied[voxel] += of_level;
      if (level == levels_ - 1) sums.upper[voxel] += of_level;
      all += of_level;
    }
    return all;
  }

  /// How many of a measured ray reach each voxel on it.
  void add_reach(const Ray& ray, const std::vector<double>& share, double evidence, std::vector<double>& reach) const {
    for (std::size_t number = 0; number < share.size(); ++number) {
      double survival = share[number] / evidence * ray.weight;
      std::size_t rest = number;
      for (const VoxelSegment& s : ray.segments) {
        reach[s.voxel] += survival;
        survival *= model_.transmission(next_level(rest), (s.exit - s.enter) / grid_.resolution);
      }
    }
  }

  const VoxelGrid& grid_;
  const ForwardSensorModel& model_;
  std::size_t levels_;
  Levels map_;
  std::vector<double> log_prior_;                          // of a voxel, by its level
  std::map<std::vector<std::uint32_t>, RayTable> tables_;  // by the rays' voxels, in the rays' order
  std::vector<std::vector<RayTable*>> ending_;             // by voxel: those whose voxels have no higher number
  double log_of_no_voxel_ = 0.0;                           // of rays that pass the grid by
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

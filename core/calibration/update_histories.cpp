#include "core/calibration/update_histories.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/evaluation/touched_voxels.hpp"

namespace nextview {
namespace {

constexpr std::size_t chunk = 4096;  // histories summed on their own; the chunks' sums are added in order

enum Touch : std::uint8_t { untouched = 0, missed = 1, was_hit = 2 };

bool is_hit(float update) { return !std::signbit(update); }

std::size_t at(SensorParameter parameter) { return static_cast<std::size_t>(parameter); }

/// One voxel's log-odds while the updates go by, and their derivatives by the parameters.
class VoxelReplay {
 public:
  explicit VoxelReplay(const InverseSensorModel& model)
      : hit_(nextview::log_odds(model.hit)),
        miss_(nextview::log_odds(model.miss)),
        lowest_(nextview::log_odds(model.clamp_min)),
        highest_(nextview::log_odds(model.clamp_max)),
        hit_decay_(model.hit_decay),
        miss_decay_(model.miss_decay) {}

  void run(std::span<const float> updates) {
    log_odds_ = 0.0;
    derivatives_ = {};
    for (const float update : updates) apply(update);
  }
  double log_odds() const { return log_odds_; }
  const std::array<double, sensor_parameters>& derivatives() const { return derivatives_; }

 private:
  /// As OccupancyMap: adds the term, then clamps.
  void apply(float update) {
    const double range = std::abs(update);
    const bool hit = is_hit(update);
    const double factor = range_factor(hit ? hit_decay_ : miss_decay_, range);
    const double term = (hit ? hit_ : miss_) * factor;
    log_odds_ += term;
    if (log_odds_ < lowest_) return clamp(lowest_, SensorParameter::clamp_min);
    if (log_odds_ > highest_) return clamp(highest_, SensorParameter::clamp_max);
    derivatives_[at(hit ? SensorParameter::hit : SensorParameter::miss)] += factor;
    derivatives_[at(hit ? SensorParameter::hit_decay : SensorParameter::miss_decay)] += (1.0 - range) * term;
  }
  /// What came before is forgotten: from here on the log-odds move with the clamp.
  void clamp(double bound, SensorParameter parameter) {
    log_odds_ = bound;
    derivatives_ = {};
    derivatives_[at(parameter)] = 1.0;
  }

  double hit_, miss_, lowest_, highest_, hit_decay_, miss_decay_;
  double log_odds_ = 0.0;
  std::array<double, sensor_parameters> derivatives_{};
};

/// -ln of the probability that belongs to these log-odds.
double surprise(double log_odds) {
  return log_odds > 0.0 ? std::log1p(std::exp(-log_odds)) : std::log1p(std::exp(log_odds)) - log_odds;
}

void require_sizes_and_targets(const VoxelGrid& grid, std::span<const Scan> scans, std::span<const float> target,
                               std::span<const std::uint8_t> mask) {
  for (const Scan& scan : scans)
    if (!(scan.max_range > 0.0))
      throw std::invalid_argument(fmt::format("update histories: max_range must be over 0 m, not {}", scan.max_range));
  if (target.size() != grid.voxel_count() || mask.size() != grid.voxel_count())
    throw std::invalid_argument(fmt::format("update histories: {} targets and a mask of {} for a grid of {} voxels",
                                            target.size(), mask.size(), grid.voxel_count()));
  for (std::size_t v = 0; v < target.size(); ++v)
    if (mask[v] != 0 && !(target[v] >= 0.0f && target[v] <= 1.0f))
      throw std::invalid_argument(
          fmt::format("update histories: the target of voxel {} must be from 0 to 1, not {}", v, target[v]));
}

}  // namespace

void UpdateHistories::add(const VoxelGrid& grid, std::span<const Scan> scans, std::span<const float> target,
                          std::span<const std::uint8_t> mask, const std::stop_token& stop) {
  require_sizes_and_targets(grid, scans, target, mask);
  std::vector<std::vector<std::uint8_t>> touches;  // [scan][voxel]
  std::size_t count = 0;
  for (const Scan& scan : scans) {
    auto& touched = touches.emplace_back(grid.voxel_count(), untouched);
    visit_touched_voxels(grid, scan, stop, [&](std::uint32_t voxel, bool hit) {
      touched[voxel] = mask[voxel] == 0 ? untouched : hit ? was_hit : missed;
      count += mask[voxel] != 0;
    });
  }
  updates_.reserve(updates_.size() + count);
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
    if (mask[v] == 0) continue;
    const std::size_t begin = updates_.size();
    const Vector3 centre = grid.centre(v);
    for (std::size_t s = 0; s < scans.size(); ++s) {
      if (touches[s][v] == untouched) continue;
      const auto range = static_cast<float>((centre - scans[s].origin).norm());
      updates_.push_back(touches[s][v] == was_hit ? range : -range);
    }
    if (updates_.size() == begin) continue;
    histories_.push_back({updates_.size(), 1.0, target[v]});
    ++voxels_;
  }
}

void UpdateHistories::append(const UpdateHistories& others) {
  const std::size_t before = updates_.size();
  updates_.insert(updates_.end(), others.updates_.begin(), others.updates_.end());
  for (const History& history : others.histories_)
    histories_.push_back({before + history.end, history.voxels, history.occupied});
  voxels_ += others.voxels_;
}

std::span<const float> UpdateHistories::updates(std::size_t history) const {
  const std::size_t begin = history == 0 ? 0 : histories_[history - 1].end;
  return std::span(updates_).subspan(begin, histories_[history].end - begin);
}

CrossEntropy UpdateHistories::cross_entropy(const InverseSensorModel& model) const {
  model.validate();
  if (voxels_ == 0) throw std::invalid_argument("update histories: no scan touched a voxel of the mask");
  std::vector<CrossEntropy> sums((histories_.size() + chunk - 1) / chunk);
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t c) {
    VoxelReplay voxel(model);
    CrossEntropy sum;
    for (std::size_t h = c * chunk; h < std::min((c + 1) * chunk, histories_.size()); ++h) {
      const History& history = histories_[h];
      voxel.run(updates(h));
      const double log_odds = voxel.log_odds(), free = history.voxels - history.occupied;
      sum.value += history.occupied * surprise(log_odds) + free * surprise(-log_odds);
      const double by_log_odds = history.voxels * probability(log_odds) - history.occupied;
      for (std::size_t k = 0; k < sensor_parameters; ++k) sum.gradient[k] += by_log_odds * voxel.derivatives()[k];
    }
    sums[c] = sum;
  });
  CrossEntropy mean;
  const auto count = static_cast<double>(voxels_);
  for (const CrossEntropy& sum : sums) {
    mean.value += sum.value / count;
    for (std::size_t k = 0; k < sensor_parameters; ++k) mean.gradient[k] += sum.gradient[k] / count;
  }
  return mean;
}

std::vector<double> UpdateHistories::probabilities(const InverseSensorModel& model) const {
  model.validate();
  std::vector<double> result(histories_.size());
  VoxelReplay voxel(model);
  for (std::size_t h = 0; h < result.size(); ++h) {
    voxel.run(updates(h));
    result[h] = probability(voxel.log_odds());
  }
  return result;
}

UpdateHistories UpdateHistories::without_ranges() const {
  struct Node {
    std::uint32_t before = 0;             ///< the node without the last update; 0: the root
    std::array<std::uint32_t, 2> next{};  ///< with a miss or a hit more; 0: nobody has that
    bool hit = false;                     ///< the last update
    double voxels = 0.0, occupied = 0.0;
  };
  std::vector<Node> tree(1);  // of all sequences, by their beginnings
  for (std::size_t h = 0; h < histories_.size(); ++h) {
    std::uint32_t node = 0;
    for (const float update : updates(h)) {
      const bool hit = is_hit(update);
      if (tree[node].next[hit] == 0) {
        tree[node].next[hit] = static_cast<std::uint32_t>(tree.size());
        tree.push_back({node, {}, hit});
      }
      node = tree[node].next[hit];
    }
    tree[node].voxels += histories_[h].voxels;
    tree[node].occupied += histories_[h].occupied;
  }
  UpdateHistories merged;
  merged.voxels_ = voxels_;
  for (std::uint32_t n = 1; n < tree.size(); ++n) {
    if (tree[n].voxels == 0.0) continue;
    const auto begin = static_cast<std::ptrdiff_t>(merged.updates_.size());
    for (std::uint32_t i = n; i != 0; i = tree[i].before) merged.updates_.push_back(tree[i].hit ? 1.0f : -1.0f);
    std::reverse(merged.updates_.begin() + begin, merged.updates_.end());
    merged.histories_.push_back({merged.updates_.size(), tree[n].voxels, tree[n].occupied});
  }
  return merged;
}

}  // namespace nextview

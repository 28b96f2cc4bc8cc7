// All maps, and some of them: enumeration and Gibbs sampling of the plain model.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/gibbs/plain_model.hpp"

namespace nextview::plain {
namespace {

/// Counts up as an odometer does; false after the last map.
bool next_map(Levels& map, int levels) {
  for (std::uint8_t& level : map) {
    if (++level < levels) return true;
    level = 0;
  }
  return false;
}

void add_map(const Posterior& posterior, const Levels& map, double share, Marginals& sum) {
  for (std::size_t voxel = 0; voxel < map.size(); ++voxel) {
    if (map[voxel] > 0) sum.occupied[voxel] += share;
    if (map[voxel] + 1 == posterior.levels()) sum.upper[voxel] += share;
  }
  posterior.add_reach(map, share, sum.reach);
}

Marginals zeros(const Posterior& posterior) {
  const std::vector<double> none(posterior.voxel_count(), 0.0);
  return {none, none, none};
}

/// A conditional that is asked once for each map and voxel: a chain on few voxels comes by the same maps again and
/// again.
class AskedOnce {
 public:
  AskedOnce(const Conditional& conditional, const Posterior& posterior)
      : conditional_(conditional), levels_(static_cast<std::size_t>(posterior.levels())) {
    std::size_t maps = 1;
    for (std::size_t voxel = 0; voxel < posterior.voxel_count() && maps <= most_maps; ++voxel) maps *= levels_;
    if (maps <= most_maps) answers_.resize(maps * posterior.voxel_count());
  }

  const std::vector<double>& operator()(const Levels& map, std::uint32_t voxel) {
    if (answers_.empty()) return answer_ = conditional_(map, voxel);
    std::size_t number = 0;
    for (const std::uint8_t level : map) number = number * levels_ + level;
    std::vector<double>& answer = answers_[number * map.size() + voxel];
    if (answer.empty()) answer = conditional_(map, voxel);
    return answer;
  }

 private:
  static constexpr std::size_t most_maps = std::size_t{1} << 14;

  const Conditional& conditional_;
  std::size_t levels_;
  std::vector<std::vector<double>> answers_;  ///< one per map and voxel; empty: there are too many maps
  std::vector<double> answer_;                ///< the last one then
};

}  // namespace

Marginals enumerate(const Posterior& posterior) {
  std::vector<double> log_joint;
  Levels map(posterior.voxel_count(), 0);
  do log_joint.push_back(posterior.log_joint(map));
  while (next_map(map, posterior.levels()));

  const double largest = *std::max_element(log_joint.begin(), log_joint.end());
  double total = 0.0;
  for (const double value : log_joint) total += std::exp(value - largest);
  Marginals marginals = zeros(posterior);
  marginals.log_evidence = largest + std::log(total);
  for (const double value : log_joint) {  // the last map was followed by the first
    const double share = std::exp(value - largest) / total;
    if (share > 1e-13) add_map(posterior, map, share, marginals);
    next_map(map, posterior.levels());
  }
  return marginals;
}

Conditional full_conditional(const Posterior& posterior) {
  return [&posterior](const Levels& map, std::uint32_t voxel) {
    std::vector<double> weights = posterior.log_conditional(map, voxel);
    const double largest = *std::max_element(weights.begin(), weights.end());
    for (double& weight : weights) weight = std::exp(weight - largest);
    return weights;
  };
}

Conditional thresholded_conditional(const Posterior& posterior) {
  return [full = full_conditional(posterior)](const Levels& map, std::uint32_t voxel) {
    const std::vector<double> weights = full(map, voxel);
    const double p = weights.at(1) / (weights.at(0) + weights.at(1)) > 0.5 ? 0.7 : 0.4;
    return std::vector<double>{1.0 - p, p};
  };
}

std::vector<Marginals> gibbs_sampler(const Posterior& posterior, const Conditional& conditional, int sweeps,
                                     int batches, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Levels map(posterior.voxel_count(), 0);
  AskedOnce weights_of(conditional, posterior);
  const auto sweep = [&] {
    for (std::uint32_t voxel = 0; voxel < map.size(); ++voxel) {
      const std::vector<double>& weights = weights_of(map, voxel);
      double total = 0.0;
      for (const double weight : weights) total += weight;
      double left = uniform() * total;
      std::uint8_t level = 0;
      while (level + 1 < posterior.levels() && left >= weights[level]) left -= weights[level++];
      map[voxel] = level;
    }
  };
  for (int burn_in = 0; burn_in < 200; ++burn_in) sweep();
  std::vector<Marginals> means;
  for (int batch = 0; batch < batches; ++batch) {
    means.push_back(zeros(posterior));
    const int length = sweeps / batches;
    for (int i = 0; i < length; ++i) {
      sweep();
      add_map(posterior, map, 1.0 / length, means.back());
    }
  }
  return means;
}

}  // namespace nextview::plain

#include "core/gibbs/read_out.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nextview {
namespace {

/// Log-odds of a posterior mean, kept within what some hundred sweeps can tell.
double kept_log_odds(double p) { return log_odds(std::clamp(p, 1e-4, 1.0 - 1e-4)); }

}  // namespace

std::vector<RayCount> ray_counts(const RayLists& lists) {
  std::vector<RayCount> counts(lists.grid().voxel_count());
  tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t v) {
    const auto voxel = static_cast<std::uint32_t>(v);
    for (const RayLists::FrontEntry entry : lists.front(voxel)) counts[v].passed += float(lists.weight(entry.ray()));
    for (const RayLists::NearEntry entry : lists.near(voxel)) {
      const float weight = static_cast<float>(lists.weight(entry.ray));
      switch (lists.incidence(entry.incidence).place) {
        case RayLists::Place::in_front:
          counts[v].passed += weight;
          break;
        case RayLists::Place::at_range:
          counts[v].ended += weight;
          break;
        case RayLists::Place::behind:
          break;
      }
    }
  });
  return counts;
}

ReadOutFeatures::Word& ReadOutFeatures::Word::operator+=(const Word& other) {
  uninformed += other.uninformed;
  occupied += other.occupied;
  upper += other.upper;
  log_odds += other.log_odds;
  uncrossed += other.uncrossed;
  ended += other.ended;
  log_ended += other.log_ended;
  log_crossed += other.log_crossed;
  return *this;
}

ReadOutFeatures::ReadOutFeatures(const GibbsPosterior& posterior, std::span<const RayCount> rays)
    : grid_(posterior.grid),
      occupied_(posterior.occupied),
      upper_(posterior.upper),
      rays_(rays),
      words_(posterior.occupied.size()) {
  tbb::parallel_for(std::size_t{0}, words_.size(), [&](std::size_t v) {
    Word& word = words_[v];
    if (posterior.informed[v]) {
      word.occupied = posterior.occupied[v];
      word.upper = posterior.upper[v];
      word.log_odds = static_cast<float>(kept_log_odds(posterior.occupied[v]));
    } else {
      word.uninformed = 1.0f;
    }
    const float crossed = rays[v].crossed();
    word.uncrossed = crossed == 0.0f ? 1.0f : 0.0f;
    word.ended = rays[v].ended / (crossed + 0.1f);
    word.log_ended = std::log1p(rays[v].ended);
    word.log_crossed = std::log1p(crossed);
  });
}

ReadOutFeatures::Around ReadOutFeatures::around(std::uint32_t voxel) const {
  const Eigen::Vector3i centre = grid_.cell(voxel);
  Around around;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const int steps = std::abs(x) + std::abs(y) + std::abs(z);
        const Eigen::Vector3i cell = centre + Eigen::Vector3i(x, y, z);
        if (steps == 0 || !grid_.contains(cell)) continue;
        const Word& word = words_[grid_.index(cell)];
        around.all += word;
        if (steps == 1) around.faces += word;
      }
  return around;
}

ReadOutFeatures::Vector ReadOutFeatures::of(std::uint32_t voxel) const {
  const double occupied = kept_log_odds(occupied_[voxel]), upper = kept_log_odds(upper_[voxel]);
  const RayCount& rays = rays_[voxel];
  const double ended = std::log((rays.ended + 0.05) / (rays.passed + 0.05));
  const Around a = around(voxel);
  // Divided so that all are of a size.
  return {1.0,
          occupied,
          upper,
          occupied * occupied / 10.0,
          upper * upper / 10.0,
          a.faces.uninformed,
          a.all.uninformed,
          a.faces.occupied,
          a.all.occupied,
          a.faces.upper,
          a.all.upper,
          a.faces.log_odds / 6.0,
          std::log1p(rays.crossed()),
          ended,
          ended * ended / 10.0,
          a.faces.uncrossed,
          a.all.uncrossed,
          a.faces.ended,
          a.all.ended,
          a.all.log_crossed / 26.0,
          std::log1p(rays.ended),
          a.all.log_ended / 26.0,
          a.faces.log_ended / 6.0};
}

const ReadOutWeights& fitted_read_out() {
  static const ReadOutWeights weights{
      {-4.6952, 0.9472,  -0.3000, -0.7803, 0.2314, -1.2713, -0.6923, 0.7293,  1.9102, 0.5324, -2.1812, 0.6013,
       0.7265,  -0.3003, -0.2799, 0.7093,  1.1223, 0.9690,  -0.1375, -0.9224, 1.3527, 0.4654, 1.0395},
      {-6.2338, -0.3419, 0.8046, 0.1005, -0.3274, -0.5272, 0.2193,  0.1279, 3.1746, -0.3930, -2.8634, 0.4597,
       -2.3922, -0.0196, 0.0135, 1.2608, 0.3192,  1.4571,  -0.6929, 0.2795, 0.8003, 3.1226,  -0.5686}};
  return weights;
}

void read_out(GibbsPosterior& posterior, std::span<const RayCount> rays, const ReadOutWeights& weights) {
  const ReadOutFeatures features(posterior, rays);
  posterior.touch.assign(posterior.occupied.size(), 0.5f);
  posterior.centre = posterior.touch;
  tbb::parallel_for(std::size_t{0}, posterior.occupied.size(), [&](std::size_t v) {
    if (!posterior.informed[v]) return;
    const ReadOutFeatures::Vector x = features.of(static_cast<std::uint32_t>(v));
    const auto logistic = [&](const ReadOutFeatures::Vector& w) {
      return static_cast<float>(probability(std::inner_product(x.begin(), x.end(), w.begin(), 0.0)));
    };
    posterior.touch[v] = logistic(weights.touch);
    posterior.centre[v] = logistic(weights.centre);
  });
}

}  // namespace nextview

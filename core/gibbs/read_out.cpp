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
    RayCount& count = counts[v];
    for (const RayLists::FrontEntry entry : lists.front(voxel)) count.passed += float(lists.weight(entry.ray()));
    for (const RayLists::NearEntry entry : lists.near(voxel)) {
      const float weight = static_cast<float>(lists.weight(entry.ray));
      const RayLists::Place place = lists.incidence(entry.incidence).place;
      if (place == RayLists::Place::in_front) count.passed += weight;
      if (place == RayLists::Place::at_range) count.ended += weight;
      const RayLists::RangeFrom range = lists.range_from(voxel, entry.ray);
      if (range.way > RayCount::reach) continue;
      count.near += weight;
      count.behind += weight * range.centre;
    }
    if (count.near > 0.0f) count.behind /= count.near;
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
          a.faces.log_ended / 6.0,
          rays.near > 0.0f ? 1.0 : 0.0,
          rays.behind,
          rays.behind * rays.behind,
          std::abs(rays.behind),
          rays.behind * std::log1p(rays.near) / 5.0};
}

const ReadOutWeights& fitted_read_out() {
  static const ReadOutWeights weights{
      {-6.0810, 0.7657,  -0.7390, 0.3478,  -0.2972, -1.3167, -0.6338, -1.5415, 2.4567,  1.8548,
       -2.5610, 1.1977,  0.2199,  -0.0644, -0.2183, 0.0608,  1.2163,  0.9131,  -0.1335, 0.0014,
       0.2763,  -1.0170, 0.8680,  3.5287,  -1.8664, -1.4604, 0.1226,  0.5808},
      {-7.1147, -0.4634, 0.7672,  0.2079,  -0.3928, -0.5561, 0.2973,  -1.3790, 2.1871,  1.2590,
       -1.9872, 0.2314,  -2.1293, -0.2926, 0.1951,  0.5361,  0.2583,  1.0566,  -0.2647, 0.3288,
       1.3846,  0.9902,  -0.3877, 2.0829,  0.9530,  -0.7013, -0.8709, -15.5225}};
  return weights;
}

void read_out(GibbsPosterior& posterior, std::span<const RayCount> rays, const ReadOutWeights& weights) {
  const ReadOutFeatures features(posterior, rays);
  posterior.touch.assign(posterior.occupied.size(), 0.5f);
  posterior.centre = posterior.touch;
  tbb::parallel_for(std::size_t{0}, posterior.occupied.size(), [&](std::size_t v) {
    if (!posterior.informed[v]) return;
    const ReadOutFeatures::Vector x = features.of(static_cast<std::uint32_t>(v));
    // Where rays only passed, what nobody looked at around it is no evidence of a surface.
    const float most = ReadOutFeatures::a_ray_ended_near(x) ? 1.0f : posterior.occupied[v];
    const auto logistic = [&](const ReadOutFeatures::Vector& w) {
      return std::min(most, static_cast<float>(probability(std::inner_product(x.begin(), x.end(), w.begin(), 0.0))));
    };
    posterior.touch[v] = logistic(weights.touch);
    posterior.centre[v] = logistic(weights.centre);
  });
}

}  // namespace nextview

#include "core/gibbs/read_out.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
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

ReadOutFeatures::ReadOutFeatures(const GibbsPosterior& posterior, std::span<const RayCount> rays)
    : grid_(posterior.grid), upper_(posterior.upper), rays_(rays), words_(posterior.occupied.size()) {
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
    word.passed = crossed > 0.0f && rays[v].near == 0.0f ? 1.0f : 0.0f;
    word.near = rays[v].near > 0.0f ? 1.0f : 0.0f;
    word.behind = rays[v].behind;
  });
}

ReadOutFeatures::Around ReadOutFeatures::around(std::uint32_t voxel) const {
  const Eigen::Vector3i centre = grid_.cell(voxel);
  static const Word beyond = [] {
    Word word;
    word.passed = 1.0f;
    return word;
  }();
  Around around;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const int steps = std::abs(x) + std::abs(y) + std::abs(z);
        const Eigen::Vector3i cell = centre + Eigen::Vector3i(x, y, z);
        if (steps == 0) continue;
        const Word& word = grid_.contains(cell) ? words_[grid_.index(cell)] : beyond;
        around.all += word;
        if (steps == 1) around.faces += word;
      }
  return around;
}

ReadOutFeatures::Vector ReadOutFeatures::of(std::uint32_t voxel) const {
  const RayCount& rays = rays_[voxel];
  const Word& own = words_[voxel];
  const Around a = around(voxel);
  return {1.0f,
          own.log_odds,
          static_cast<float>(kept_log_odds(upper_[voxel])),
          a.faces.uninformed,
          a.all.uninformed,
          a.faces.occupied,
          a.all.occupied,
          a.faces.upper,
          a.all.upper,
          a.faces.log_odds,
          own.log_crossed,
          std::log((rays.ended + 0.05f) / (rays.passed + 0.05f)),
          a.faces.uncrossed,
          a.all.uncrossed,
          a.faces.ended,
          a.all.ended,
          a.all.log_crossed,
          own.log_ended,
          a.all.log_ended,
          a.faces.log_ended,
          own.near,
          own.behind,
          rays.behind * std::log1p(rays.near),
          a.faces.passed,
          a.all.passed,
          a.faces.behind / (a.faces.near + 0.5f),
          a.all.behind / (a.all.near + 0.5f)};
}

float ReadOutNetwork::log_odds(const ReadOutFeatures::Vector& features) const {
  using Units = Eigen::Array<float, units, 1>;
  const auto of = [](const OfUnits& values) { return Eigen::Map<const Units>(values.data()); };
  Units sums = Units::Zero();
  for (std::size_t k = 0; k < features.size(); ++k) sums += features[k] * of(in[k]);
  const Units bent = of(out) * sums / (1.0f + sums.abs());
  const float straight = std::inner_product(features.begin(), features.end(), linear.begin(), 0.0f);
  return std::accumulate(bent.begin(), bent.end(), straight);
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
    const auto answer = [&](const ReadOutNetwork& network) {
      return std::min(most, static_cast<float>(probability(network.log_odds(x))));
    };
    posterior.touch[v] = answer(weights.touch);
    posterior.centre[v] = answer(weights.centre);
  });
}

}  // namespace nextview

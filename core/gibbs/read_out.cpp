#include "core/gibbs/read_out.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gibbs/weighted_logs.hpp"

namespace nextview {
namespace {

/// Log-odds of a posterior mean, kept within what some hundred sweeps can tell.
float kept_log_odds(float p) {
  p = std::clamp(p, 1e-4f, 1.0f - 1e-4f);
  return WeightedLogs::log(p / (1.0f - p));
}

}  // namespace

ReadOutRays read_out_rays(const RayLists& lists, std::optional<BitRows> counted) {
  std::vector<RayCount> counts(lists.grid().voxel_count());
  tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t v) {
    const auto voxel = static_cast<std::uint32_t>(v);
    if (counted && !counted->at(lists.grid().cell(voxel))) return;
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
  return {std::move(counts), RayEnds(lists), std::move(counted)};
}

ReadOutFeatures::ReadOutFeatures(const GibbsPosterior& posterior, const ReadOutRays& rays, const Layers& layers)
    : posterior_(posterior), rays_(rays) {
  const Eigen::Vector3i& size = posterior.grid.size;
  const std::size_t layer = std::size_t(size.x()) * size.y();
  first_word_ = layer * std::size_t(std::max(0, layers.first - 1));
  words_.resize(layer * std::size_t(std::min(size.z(), layers.last + 1)) - first_word_);
  for (std::size_t k = 0; k < words_.size(); ++k) {
    const auto voxel = static_cast<std::uint32_t>(first_word_ + k);
    if (!rays.counted || rays.counted->at(posterior.grid.cell(voxel))) words_[k] = word_of(voxel);
  }
}

ReadOutFeatures::Word ReadOutFeatures::word_of(std::uint32_t voxel) const {
  Word word = Word::Zero();
  if (posterior_.informed[voxel]) {
    word[occupied] = posterior_.occupied[voxel];
    word[upper] = posterior_.upper[voxel];
    word[log_odds_occupied] = kept_log_odds(posterior_.occupied[voxel]);
  } else {
    word[uninformed] = 1.0f;
  }
  const RayCount& rays = rays_.counts[voxel];
  const float crossed = rays.crossed();
  word[uncrossed] = crossed == 0.0f ? 1.0f : 0.0f;
  word[ended] = rays.ended / (crossed + 0.1f);
  word[log_ended] = std::log1p(rays.ended);
  word[log_crossed] = std::log1p(crossed);
  word[passed] = crossed > 0.0f && rays.near == 0.0f ? 1.0f : 0.0f;
  word[near] = rays.near > 0.0f ? 1.0f : 0.0f;
  word[behind] = rays.behind;
  return word;
}

ReadOutFeatures::Around ReadOutFeatures::around(std::uint32_t voxel) const {
  const VoxelGrid& grid = posterior_.grid;
  const Eigen::Vector3i centre = grid.cell(voxel);
  static const Word beyond = [] {
    Word word = Word::Zero();
    word[passed] = 1.0f;
    return word;
  }();
  Around around;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const int steps = std::abs(x) + std::abs(y) + std::abs(z);
        const Eigen::Vector3i cell = centre + Eigen::Vector3i(x, y, z);
        if (steps == 0) continue;
        const Word& word = grid.contains(cell) ? said_by(grid.index(cell)) : beyond;
        around.all += word;
        if (steps == 1) around.faces += word;
      }
  return around;
}

ReadOutFeatures::Vector ReadOutFeatures::of(std::uint32_t voxel) const {
  const RayCount& rays = rays_.counts[voxel];
  const SurfacePatch patch = rays_.ends.patch(voxel);
  const SurfacePatch wide = rays_.ends.wide_patch(voxel);
  const float wide_sharp = 1.0f / (wide.roughness + 0.1f);
  const float inside = patch.half - std::abs(patch.distance), sharp = 1.0f / (patch.roughness + 0.1f);
  const Word& own = said_by(voxel);
  const Around a = around(voxel);
  return {1.0f,
          own[log_odds_occupied],
          kept_log_odds(posterior_.upper[voxel]),
          a.faces[uninformed],
          a.all[uninformed],
          a.faces[occupied],
          a.all[occupied],
          a.faces[upper],
          a.all[upper],
          a.faces[log_odds_occupied],
          own[log_crossed],
          std::log((rays.ended + 0.05f) / (rays.passed + 0.05f)),
          a.faces[uncrossed],
          a.all[uncrossed],
          a.faces[ended],
          a.all[ended],
          a.all[log_crossed],
          own[log_ended],
          a.all[log_ended],
          a.faces[log_ended],
          own[near],
          own[behind],
          rays.behind * std::log1p(rays.near),
          a.faces[passed],
          a.all[passed],
          a.faces[behind] / (a.faces[near] + 0.5f),
          a.all[behind] / (a.all[near] + 0.5f),
          std::log1p(patch.ends),
          patch.distance,
          patch.distance * sharp,
          inside,
          inside * sharp,
          patch.roughness,
          patch.incidence,
          patch.from_behind,
          patch.distance_from_behind,
          wide.distance,
          wide.distance * wide_sharp,
          wide.half - std::abs(wide.distance),
          wide.roughness,
          wide.incidence};
}

void read_out(GibbsPosterior& posterior, const ReadOutRays& rays, const ReadOutWeights& weights, const BitRows* asked) {
  constexpr int thickness = 8;  // layers at a time, so that what is made ready for them takes little memory
  posterior.touch.resize(posterior.occupied.size(), 0.5f);
  posterior.centre.resize(posterior.occupied.size(), 0.5f);
  const Eigen::Vector3i& size = posterior.grid.size;
  tbb::parallel_for(0, (size.z() + thickness - 1) / thickness, [&](int block) {
    const ReadOutFeatures::Layers layers{block * thickness, std::min(size.z(), (block + 1) * thickness)};
    const ReadOutFeatures features(posterior, rays, layers);
    const auto voxels_before = [&](int z) { return posterior.grid.index({0, 0, z}); };
    for (std::uint32_t v = voxels_before(layers.first); v < voxels_before(layers.last); ++v) {
      if (asked && !asked->at(posterior.grid.cell(v))) continue;
      posterior.touch[v] = posterior.centre[v] = 0.5f;
      if (!posterior.informed[v]) continue;
      const ReadOutFeatures::Vector x = features.of(v);
      // Where rays only passed, what nobody looked at around it is no evidence of a surface.
      const float most = ReadOutFeatures::a_ray_ended_near(x) ? 1.0f : posterior.occupied[v];
      const auto answer = [&](const ReadOutNetwork& network) {
        return std::min(most, static_cast<float>(probability(network.log_odds(x))));
      };
      posterior.touch[v] = answer(weights.touch);
      posterior.centre[v] = answer(weights.centre);
    }
  });
}

}  // namespace nextview

#include "core/gain/view_score.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>

namespace nextview {
namespace {

/// pi_0 = 1; pi_{i+1} = pi_i (1 - p_i), or pi_i p_i in the reference code.
void visibility_along(std::span<const RayVoxel> voxels, Semantics semantics, std::vector<double>& visibility) {
  visibility.resize(voxels.size());
  double pi = 1.0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    visibility[i] = pi;
    const double p = voxels[i].probability;
    pi *= semantics == Semantics::published ? 1.0 - p : p;
  }
}

/// Casts the rays of one view, in order, and hands each to `use(ray, direction in the world)`. False if stopped.
template <class Use>
bool for_each_ray(const RayCaster& caster, const Pose& view, const RayBundle& bundle, const ScoreOptions& options,
                  const std::stop_token& stop, Use use) {
  constexpr std::size_t between_looks = 256;  // at the stop token [rays]
  std::vector<RayVoxel> visited;
  std::vector<double> visibility;
  const Vector3 origin = view.translation();
  std::size_t cast = 0;
  for (const Vector3& direction : bundle.directions) {
    if (cast++ % between_looks == 0 && stop.stop_requested()) return false;
    const Vector3 along = view.linear() * direction;
    caster.cast(origin, along, visited);
    visibility_along(visited, options.semantics, visibility);
    use(Ray{visited, visibility, options.semantics, options.occlusion_reach}, along);
  }
  return true;
}

/// Adds one ray to the sums of its view: its own sums first, as rays in lanes are added up, to round alike.
void add_ray(const Gain& gain, const Ray& ray, GainSums& sums) {
  GainSums of_ray{{}, sums.node_seen};
  gain.add_ray(ray, of_ray);
  for (std::size_t k = 0; k < sums.sum.size(); ++k) sums.sum[k] += of_ray.sum[k];
  sums.node_seen = of_ray.node_seen;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// By one gain after the other, each in lanes.
ViewScore score_in_lanes(std::span<const WorthOfMap> maps, const Pose& view, const RayBundle& bundle) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Vector3> directions;
  for (const Vector3& direction : bundle.directions) directions.emplace_back(view.linear() * direction);
  std::vector<double> sums(directions.size());
  ViewScore score;
  for (const WorthOfMap& map : maps) {
    const RaysThroughGrid rays{map.grid, view.translation(), directions, map.max_range};
    score.voxels = std::max(score.voxels, sum_along_rays(rays, map.field, sums));
    double value = 0.0;
    for (const double sum : sums) value += sum;
    score.gains.push_back(value);
  }
  score.rays = directions.size();
  score.milliseconds = milliseconds_since(start);
  return score;
}

/// What the caster's map is worth to each gain; empty if any of them needs rays one by one.
std::vector<WorthOfMap> worth_of_map(const RayCaster& caster, std::span<const Gain* const> gains,
                                     const ScoreOptions& options) {
  std::vector<WorthOfMap> maps;
  if (options.semantics != Semantics::published || !std::ranges::all_of(gains, &Gain::worth)) return maps;
  for (const Gain* const gain : gains) {
    std::optional<WorthOfMap> map = caster.worth_of_map(*gain, options.occlusion_reach);
    if (!map) return {};
    maps.push_back(*std::move(map));
  }
  return maps;
}

}  // namespace

std::vector<ViewScore> score_views(const RayCaster& caster, std::span<const Pose> views, const RayBundle& bundle,
                                   std::span<const Gain* const> gains, const ScoreOptions& options,
                                   std::stop_token stop) {
  std::vector<ViewScore> scores(views.size());
  const std::vector<WorthOfMap> maps = worth_of_map(caster, gains, options);
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (stop.stop_requested()) return;
    if (!maps.empty()) {
      scores[v] = score_in_lanes(maps, views[v], bundle);
      return;
    }
    const auto start = std::chrono::steady_clock::now();
    ViewScore& score = scores[v];
    std::vector<GainSums> sums(gains.size());
    const bool whole = for_each_ray(caster, views[v], bundle, options, stop, [&](const Ray& ray, const Vector3&) {
      for (std::size_t g = 0; g < gains.size(); ++g) add_ray(*gains[g], ray, sums[g]);  // Eq. 10
      score.voxels += ray.voxels.size();
    });
    if (!whole) {
      score = {};
      return;
    }
    for (std::size_t g = 0; g < gains.size(); ++g) score.gains.push_back(gains[g]->value(sums[g]).value);
    score.rays = bundle.directions.size();
    score.milliseconds = milliseconds_since(start);
  });
  return scores;
}

ScoreExplanation explain_score(const RayCaster& caster, const Pose& view, const RayBundle& bundle, const Gain& gain,
                               const ScoreOptions& options) {
  GainSums sums;
  for_each_ray(caster, view, bundle, options, {}, [&](const Ray& ray, const Vector3&) { add_ray(gain, ray, sums); });
  const GainValue total = gain.value(sums);

  ScoreExplanation explanation;
  explanation.value = total.value;
  GainSums again;  // what a gain carries from ray to ray is carried here too
  for_each_ray(caster, view, bundle, options, {}, [&](const Ray& ray, const Vector3& direction) {
    std::vector<double> contribution(ray.voxels.size(), 0.0);
    gain.explain_ray(ray, again, total.worth, contribution);
    ScoreExplanation::RayPart& part = explanation.rays.emplace_back();
    part.direction = direction;
    for (std::size_t i = 0; i < ray.voxels.size(); ++i) {
      const RayVoxel& v = ray.voxels[i];
      part.voxels.push_back({v.lattice, v.measured, v.probability, ray.visibility[i], contribution[i]});
      part.contribution += contribution[i];
    }
  });
  return explanation;
}

}  // namespace nextview

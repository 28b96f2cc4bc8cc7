#include "core/gain/view_score.hpp"

#include <tbb/parallel_for.h>

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

}  // namespace

std::vector<ViewScore> score_views(const RayCaster& caster, std::span<const Pose> views, const RayBundle& bundle,
                                   std::span<const Gain* const> gains, const ScoreOptions& options,
                                   std::stop_token stop) {
  std::vector<ViewScore> scores(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (stop.stop_requested()) return;
    const auto start = std::chrono::steady_clock::now();
    ViewScore& score = scores[v];
    std::vector<GainSums> sums(gains.size());
    const bool whole = for_each_ray(caster, views[v], bundle, options, stop, [&](const Ray& ray, const Vector3&) {
      for (std::size_t g = 0; g < gains.size(); ++g) gains[g]->add_ray(ray, sums[g]);  // Eq. 10
      score.voxels += ray.voxels.size();
    });
    if (!whole) {
      score = {};
      return;
    }
    for (std::size_t g = 0; g < gains.size(); ++g) score.gains.push_back(gains[g]->value(sums[g]).value);
    score.rays = bundle.directions.size();
    score.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  });
  return scores;
}

ScoreExplanation explain_score(const RayCaster& caster, const Pose& view, const RayBundle& bundle, const Gain& gain,
                               const ScoreOptions& options) {
  GainSums sums;
  for_each_ray(caster, view, bundle, options, {}, [&](const Ray& ray, const Vector3&) { gain.add_ray(ray, sums); });
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

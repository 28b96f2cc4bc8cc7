#include "core/planner/adaptive_candidates.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "core/planner/look_directions.hpp"
#include "core/planner/new_surface_policy.hpp"
#include "core/random/counter_random.hpp"
#include "core/random/on_sphere.hpp"

namespace nextview {
namespace {

// How many poses are drawn all around, and about places (up to three of each); how many are looked at closer, and how
// many of these have another one drawn about them.
constexpr std::uint64_t around = 150;
constexpr std::size_t frontiers = 100, looked_at = 90, centres = 30;
constexpr std::size_t few_rays = 3;                          // one in so many, for all poses that are drawn
constexpr double nearest_share = 0.4, farthest_share = 1.1;  // of the configured distance
constexpr double scatter = 0.14;                             // of what is looked at, as a share of the object's size
constexpr double spread = 0.1;                               // of Gaussian samples, as a share of the way to the object
constexpr double clearance = 0.15;                           // at least, from the object's box, as a share of its size

bool alike(const Pose& a, const Pose& b, double distance) {
  constexpr double near = 0.2;             // as a share of the distance
  constexpr double same_direction = 0.97;  // cosine, of 14 degrees
  return (a.translation() - b.translation()).norm() < near * distance &&
         a.linear().col(2).dot(b.linear().col(2)) > same_direction;
}

/// Every so many of the rays, each for those that are left out too.
RayBundle thinned(const RayBundle& rays, std::size_t every) {
  RayBundle few;
  double all = 0.0, kept = 0.0;
  for (std::size_t i = 0; i < rays.directions.size(); ++i) {
    all += rays.solid_angles[i];
    if (i % every != 0) continue;
    few.directions.push_back(rays.directions[i]);
    few.solid_angles.push_back(rays.solid_angles[i]);
    kept += rays.solid_angles[i];
  }
  for (double& solid_angle : few.solid_angles) solid_angle *= all / kept;
  return few;
}

std::vector<std::size_t> largest_first(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  return order;
}

std::vector<Pose> best(const std::vector<Pose>& poses, const std::vector<double>& values, std::size_t count) {
  std::vector<Pose> some;
  for (const std::size_t i : largest_first(values)) {
    if (some.size() == count) break;
    some.push_back(poses[i]);
  }
  return some;
}

/// How much a view shows that others, which showed this much of each part, did not [cm^2].
double added(const std::vector<float>& parts, const std::vector<float>& shown) {
  double sum = 0.0;
  for (std::size_t p = 0; p < parts.size(); ++p) sum += std::max(0.0f, parts[p] - shown[p]);
  return sum;
}

/// The poses that show most, and as every third one that which adds most to those before it: a bore is small. No two
/// are alike.
std::vector<std::size_t> chosen(const NewSurfaceForecast& forecast, const std::vector<Pose>& poses,
                                const AdaptiveCandidatesConfig& config) {
  std::vector<std::size_t> all, left(poses.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<float> shown(forecast.most.size(), 0.0f);
  while (all.size() < std::size_t(config.kept) && !left.empty()) {
    const bool is_for_more = all.size() % 3 == 2;
    const auto best = std::ranges::max_element(
        left, {}, [&](std::size_t v) { return is_for_more ? added(forecast.parts[v], shown) : forecast.areas[v]; });
    if (!(forecast.areas[*best] > 0.0)) break;
    const std::size_t taken = *best;
    all.push_back(taken);
    for (std::size_t p = 0; p < shown.size(); ++p) shown[p] = std::max(shown[p], forecast.parts[taken][p]);
    std::erase_if(left, [&](std::size_t v) { return v == taken || alike(poses[taken], poses[v], config.distance); });
  }
  return all;
}

}  // namespace

/// What poses are drawn by.
struct AdaptiveCandidates::Drawing {
  Drawing(const AdaptiveCandidatesConfig& config, const SurfaceEvidence& seen, const NewSurfaceField& chances,
          const VoxelGrid& region, std::size_t step)
      : evidence(seen),
        field(chances),
        random(config.seed, random_stream::adaptive_views, static_cast<std::uint32_t>(step)),
        size(seen.size() * seen.grid().resolution),
        // The box grows towards where was not looked yet: half way to the region's middle, where the object stands.
        middle(0.5 * (seen.object().center() + 0.5 * (region.lower() + region.upper()))),
        nearest(nearest_share * config.distance),
        farthest(farthest_share * config.distance),
        from_box(std::max(clearance * size, config.min_range)) {}

  double distance(double share) const { return nearest + (farthest - nearest) * share; }
  void add(std::vector<Pose>& poses, const Vector3& position, const Vector3& target) const {
    if (evidence.object().exteriorDistance(position) > from_box) poses.push_back(look_at(position, target));
  }

  const SurfaceEvidence& evidence;
  const NewSurfaceField& field;
  CounterRandom random;
  double size;  ///< of the object as far as it is known [m]
  Vector3 middle;
  double nearest, farthest;  ///< of a pose from what it looks at [m]
  double from_box;           ///< more than that is a pose from the object's box [m]
};

/// Looking at the object from all around.
std::vector<Pose> AdaptiveCandidates::all_around(const Drawing& drawing) {
  std::vector<Pose> poses;
  for (std::uint64_t i = 0; i < around; ++i) {
    const auto where = drawing.random.uniform(3 * i);
    const auto aside = drawing.random.normal(3 * i + 1), up = drawing.random.normal(3 * i + 2);
    const Vector3 direction = on_sphere(where[0], where[1]);
    const Vector3 target = drawing.middle + scatter * drawing.size * Vector3(aside[0], aside[1], up[0]);
    drawing.add(poses, target + drawing.distance(where[2]) * direction, target);
  }
  return poses;
}

/// Looking into where the map ends: along the axis of the directions in which a place lies open, as into a bore, and in
/// one of them that is drawn, as at a bore's wall. The object stays in the image.
std::vector<Pose> AdaptiveCandidates::towards_frontiers(const Drawing& drawing) {
  constexpr std::uint64_t first = 10'000;  // of its random numbers
  const auto places = frontier_places(drawing.field, drawing.evidence, frontiers, drawing.random.uniform(first)[0]);
  const LookDirections look(drawing.field);
  std::vector<std::vector<Pose>> of_place(places.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    const auto where = drawing.random.uniform(first + 1 + i);
    auto [open, directions] = look.from(places[i]);
    if (!open.empty()) directions.push_back(open[std::size_t(where[3] * double(open.size()))]);
    for (std::size_t k = 0; k < directions.size(); ++k)
      drawing.add(of_place[i], places[i] + drawing.distance(where[k]) * directions[k],
                  0.5 * (drawing.middle + places[i]));
  });
  std::vector<Pose> poses;
  for (const auto& some : of_place) poses.insert(poses.end(), some.begin(), some.end());
  return poses;
}

/// Gaussian samples about some poses.
std::vector<Pose> AdaptiveCandidates::about(const Drawing& drawing, std::span<const Pose> poses) {
  constexpr std::uint64_t first = 20'000;
  std::vector<Pose> others;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto normal = [&](std::size_t k) { return drawing.random.normal(first + 3 * i + k); };
    const auto a = normal(0), b = normal(1), c = normal(2);
    const double away = (poses[i].translation() - drawing.middle).norm();
    const Vector3 position = poses[i].translation() + spread * away * Vector3(a[0], a[1], b[0]);
    const Vector3 target = poses[i] * Vector3(0, 0, away) + 0.5 * spread * away * Vector3(b[1], c[0], c[1]);
    drawing.add(others, position, target);
  }
  return others;
}

std::vector<View> AdaptiveCandidates::candidates(const Knowledge& known) const {
  std::vector<View> views = fixed_;
  const SurfaceEvidence evidence = surface_evidence(known);
  if (evidence.grid().voxel_count() == 0) return views;
  const NewSurfaceField field(evidence, config_.model);
  const Drawing drawing(config_, evidence, field, known.map.grid(), known.taken.size());
  const NewSurfaceOptions options{config_.ray_length, config_.model.slant};
  std::vector<Pose> poses = all_around(drawing);
  std::ranges::move(towards_frontiers(drawing), std::back_inserter(poses));
  // Hierarchical rays: few for all that are drawn, more for the best of them and for what is drawn about these.
  poses = best(poses, expected_new_surface(field, poses, thinned(rays_, few_rays), options), looked_at);
  std::ranges::move(about(drawing, std::span(poses).first(std::min(centres, poses.size()))), std::back_inserter(poses));
  const NewSurfaceForecast forecast = forecast_new_surface(field, poses, rays_, options);
  for (const std::size_t i : chosen(forecast, poses, config_)) views.push_back({poses[i]});
  return views;
}

}  // namespace nextview

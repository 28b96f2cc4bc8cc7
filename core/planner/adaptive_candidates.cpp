#include "core/planner/adaptive_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/planner/new_surface_policy.hpp"
#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

constexpr int draws = 300;
constexpr double nearest_share = 0.67, farthest_share = 1.1;  // of the configured distance
constexpr double scatter = 0.14;                              // of what is looked at, as a share of the object's size
constexpr double clearance = 0.15;                            // from the object's box, as a share of its size

bool alike(const Pose& a, const Pose& b, double distance) {
  constexpr double near = 0.2;             // as a share of the distance
  constexpr double same_direction = 0.97;  // cosine, of 14 degrees
  return (a.translation() - b.translation()).norm() < near * distance &&
         a.linear().col(2).dot(b.linear().col(2)) > same_direction;
}

}  // namespace

std::vector<Pose> AdaptiveCandidates::drawn(const SurfaceEvidence& evidence, const VoxelGrid& region,
                                            std::uint32_t step) const {
  const CounterRandom random(config_.seed, random_stream::adaptive_views, step);
  const double size = evidence.size() * evidence.grid().resolution;
  // The box grows towards where was not looked yet: half way to the middle of the region, where the object stands.
  const Vector3 middle = 0.5 * (evidence.object().center() + 0.5 * (region.lower() + region.upper()));
  std::vector<Pose> poses;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const auto where = random.uniform(3 * i);
    const auto aside = random.normal(3 * i + 1), up = random.normal(3 * i + 2);
    const double z = 2.0 * where[0] - 1.0, across = std::sqrt(1.0 - z * z), turn = 2.0 * std::numbers::pi * where[1];
    const Vector3 direction(across * std::cos(turn), across * std::sin(turn), z);
    const Vector3 target = middle + scatter * size * Vector3(aside[0], aside[1], up[0]);
    const double distance = config_.distance * (nearest_share + (farthest_share - nearest_share) * where[2]);
    const Vector3 position = target + distance * direction;
    if (evidence.object().exteriorDistance(position) > clearance * size) poses.push_back(look_at(position, target));
  }
  return poses;
}

std::vector<View> AdaptiveCandidates::candidates(const Knowledge& known) const {
  std::vector<View> views = fixed_;
  const SurfaceEvidence evidence = surface_evidence(known);
  if (evidence.grid().voxel_count() == 0) return views;
  const std::vector<Pose> poses = drawn(evidence, known.map.grid(), static_cast<std::uint32_t>(known.taken.size()));
  const std::vector<double> areas =
      expected_new_surface({evidence, config_.model}, poses, rays_, {config_.ray_length, config_.model.slant});
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  int kept = 0;
  for (const std::size_t i : order) {
    if (kept == config_.kept || areas[i] <= 0.0) break;
    const auto is_alike = [&](const View& view) { return alike(view.T_world_camera, poses[i], config_.distance); };
    if (std::any_of(views.begin() + std::ptrdiff_t(fixed_.size()), views.end(), is_alike)) continue;
    views.push_back({poses[i]});
    ++kept;
  }
  return views;
}

}  // namespace nextview

#include "tests/benchmarks/known_part_plan.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <span>

namespace nextview {
namespace {

constexpr std::size_t beam_width = 150;

std::size_t new_samples(const BitMask& view, const BitMask& seen) {
  std::size_t count = 0;
  for (std::size_t w = 0; w < view.words().size(); ++w)
    count += std::size_t(std::popcount(view.words()[w] & ~seen.words()[w]));
  return count;
}

BitMask mask(std::span<const std::uint32_t> samples, std::size_t count) {
  BitMask mask(count);
  for (const std::uint32_t sample : samples) mask.set(sample);
  return mask;
}

struct PartialPlan {
  std::vector<std::size_t> views;
  BitMask seen;
  std::size_t count = 0;  ///< of samples that are seen
  Vector3 at;             ///< the camera after it [m]
  double value = 0.0;
};

/// A plan, and the view after it.
struct NextStep {
  const PartialPlan* partial;
  std::size_t view, fresh;
  double value;
};

PartialPlan follow(const NextStep& step, const BitMask& view, const Pose& T_world_camera) {
  PartialPlan partial = *step.partial;
  partial.views.push_back(step.view);
  view.for_each([&](std::size_t sample) { partial.seen.set(sample); });
  partial.count += step.fresh;
  partial.at = T_world_camera.translation();
  partial.value = step.value;
  return partial;
}

/// Of the same views with the same last one, however they were ordered, only the best goes on.
bool leads_to_like(const NextStep& step, const PartialPlan& other) {
  const std::span before(other.views.begin(), other.views.end() - 1);
  return step.view == other.views.back() && std::ranges::is_permutation(step.partial->views, before);
}

}  // namespace

std::vector<std::size_t> known_part_plan(const KnownObject& part, const Pose& T_world_start, int views,
                                         double way_weight) {
  const CandidateSight& sight = part.sight();
  std::vector<BitMask> seen_from;
  for (const auto& samples : sight.samples) seen_from.push_back(mask(samples, sight.sample_count));
  const auto visible = double(sight.visible_samples());
  const BitMask first = mask(part.samples_seen(T_world_start), sight.sample_count);
  std::vector<PartialPlan> partials = {
      {{}, first, new_samples(first, BitMask(first.size())), T_world_start.translation()}};
  for (int left = views - 1; left > 0; --left) {
    std::vector<NextStep> steps;
    for (const PartialPlan& partial : partials)
      for (std::size_t v = 0; v < seen_from.size(); ++v) {
        if (std::ranges::find(partial.views, v) != partial.views.end()) continue;
        const std::size_t fresh = new_samples(seen_from[v], partial.seen);
        const double way = (sight.candidates[v].translation() - partial.at).norm();
        const double waits = 1.0 - (double(partial.count) + 0.5 * double(fresh)) / visible;  // the share seen after it
        steps.push_back(
            {&partial, v, fresh, partial.value + double(fresh) / visible * left - way_weight * waits * way});
      }
    std::ranges::stable_sort(steps, std::greater{}, &NextStep::value);
    std::vector<PartialPlan> best;
    for (const NextStep& step : steps) {
      if (best.size() == beam_width) break;
      if (std::ranges::none_of(best, [&](const PartialPlan& other) { return leads_to_like(step, other); }))
        best.push_back(follow(step, seen_from[step.view], sight.candidates[step.view]));
    }
    partials = std::move(best);
  }
  return partials.front().views;
}

}  // namespace nextview

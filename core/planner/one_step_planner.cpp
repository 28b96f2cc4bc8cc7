#include <fmt/format.h>

#include <algorithm>

#include "core/planner/planner.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

PlanningState state_of(const PlanningSetup& setup, const Knowledge& known, std::span<const View> views,
                       const RayCaster& rays) {
  return {setup.config, setup.seed, setup.occlusion_reach, known, rays, setup.bundle, setup.true_surface,
          views,        known.taken};
}

/// "Candidate 17: 214 cm² of new surface, most of it at its top; 0.90 m away. Runner-up 32: 190 cm², 0.40 m."
std::string reason(const Policy& policy, const PlanningState& state, std::span<const Candidate> candidates,
                   std::size_t best) {
  constexpr double saturated = 0.001;  // of the largest gain
  const Candidate& chosen = candidates[best];
  std::string text =
      fmt::format("Candidate {}: {}; {:.2f} m away.", best,
                  policy.promise(chosen.gain, state, state.candidates[best].T_world_camera), chosen.cost);
  const auto second = runner_up(candidates, best);
  if (!second) return text;
  const std::string unit = policy.unit();
  text += fmt::format(" Runner-up {}: {}{}{}, {:.2f} m.", *second, short_text(candidates[*second].gain),
                      unit.empty() ? "" : " ", unit, candidates[*second].cost);
  double largest = 0.0;
  for (const Candidate& c : candidates)
    if (c.available) largest = std::max(largest, c.gain);
  const auto available = std::ranges::count_if(candidates, &Candidate::available);
  const auto as_good = std::ranges::count_if(
      candidates, [&](const Candidate& c) { return c.available && largest - c.gain <= saturated * largest; });
  if (largest > 0.0 && 2 * as_good > available)
    text += fmt::format(" {} of {} gain the same within 0.1 %: the way there decides.", as_good, available);
  return text;
}

}  // namespace

Plan OneStepPlanner::plan(const PlanningSetup& setup, const Knowledge& known, std::span<const View> views,
                          std::vector<Candidate> candidates, std::stop_token stop) const {
  std::vector<std::size_t> available;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    if (candidates[v].available) available.push_back(v);
  const auto rays = planning_rays(known, setup.config.ray_length);
  const PlanningState state = state_of(setup, known, views, *rays);
  const auto gains = policy_->values(state, available, stop);
  throw_if_stopped(stop);  // or the ranking would be half one
  for (std::size_t i = 0; i < available.size(); ++i) candidates[available[i]].gain = gains[i];
  Ranking ranking = rank(candidates, policy_->weights(setup.config));
  if (ranking.best) ranking.reason = reason(*policy_, state, candidates, *ranking.best);
  return {std::move(candidates), std::move(ranking)};
}

std::optional<ScoreExplanation> OneStepPlanner::explain(const PlanningSetup& setup, const Knowledge& known,
                                                        const Pose& T_world_camera) const {
  const auto rays = planning_rays(known, setup.config.ray_length);
  return policy_->explain(state_of(setup, known, {}, *rays), T_world_camera);
}

}  // namespace nextview

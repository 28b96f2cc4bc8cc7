#include "core/planner/planner.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

PlanningState state_of(const PlanningSetup& setup, const Knowledge& known, std::span<const View> views,
                       const RayCaster& rays) {
  return {setup.config, setup.seed, setup.occlusion_reach, known, rays, setup.bundle, setup.true_surface,
          views,        known.taken};
}

}  // namespace

Plan OneStepPlanner::plan(const PlanningSetup& setup, const Knowledge& known, std::span<const View> views,
                          std::vector<Candidate> candidates, std::stop_token stop) const {
  std::vector<std::size_t> available;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    if (candidates[v].available) available.push_back(v);
  const auto rays = planning_rays(known, setup.config.ray_length);
  const auto gains = policy_->values(state_of(setup, known, views, *rays), available, stop);
  throw_if_stopped(stop);  // or the ranking would be half one
  for (std::size_t i = 0; i < available.size(); ++i) candidates[available[i]].gain = gains[i];
  Ranking ranking = rank(candidates, policy_->weights(setup.config));
  return {std::move(candidates), std::move(ranking)};
}

std::optional<ScoreExplanation> OneStepPlanner::explain(const PlanningSetup& setup, const Knowledge& known,
                                                        const Pose& T_world_camera) const {
  const auto rays = planning_rays(known, setup.config.ray_length);
  return policy_->explain(state_of(setup, known, {}, *rays), T_world_camera);
}

}  // namespace nextview

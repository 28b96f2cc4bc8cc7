#include "core/planner/new_surface_policy.hpp"

namespace nextview {

NewSurfaceField NewSurfacePolicy::field(const PlanningState& state) const {
  const OccupancyMap& map = state.known.map;
  return {{map.grid(), state.known.planning_voxels(), map.voxels(), map.model().occupancy_threshold}, model_};
}

std::vector<double> NewSurfacePolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                                             std::stop_token stop) const {
  std::vector<Pose> views;
  for (const std::size_t v : available) views.push_back(state.candidates[v].T_world_camera);
  return expected_new_surface(field(state), views, state.bundle, options(state), stop);
}

std::optional<ScoreExplanation> NewSurfacePolicy::explain(const PlanningState& state,
                                                          const Pose& T_world_camera) const {
  return explain_new_surface(field(state), state.known.map.grid(), state.known.planning_voxels(), T_world_camera,
                             state.bundle, options(state));
}

}  // namespace nextview

#pragma once
#include <span>
#include <stop_token>
#include <vector>

#include "core/gain/view_score.hpp"
#include "core/session/configuration.hpp"
#include "core/session/known_object.hpp"

namespace nextview {

/// What ranking the candidates may look at.
struct PlanningState {
  const Configuration& configuration;
  const RayCaster& caster;
  const RayBundle& bundle;
  const KnownObject* known_object;  ///< null without evaluation; covering-order and oracle need it
  std::span<const Pose> candidates;
  std::span<const Pose> taken;  ///< the views taken so far, in order
};

/// The gain, or the baseline's stand-in for one, of each candidate in `available` (`planner.gain`). Baselines: random
/// draws a number, farthest measures the distance to the nearest view taken [m], fixed-order and covering-order count
/// down, the oracle counts the surface samples that would be seen for the first time.
std::vector<double> candidate_gains(const PlanningState& state, std::span<const std::size_t> available,
                                    std::stop_token stop);

/// Unit of `planner.gain`, for people: "nats", "voxels", "m", "samples" or "".
std::string gain_unit(const std::string& gain);
/// d_max of proximity count [voxels].
double occlusion_reach(const Configuration& configuration);
/// Whether ranking by `planner.gain` wants the map's occlusion distances.
bool needs_occlusion(const Configuration& configuration);

}  // namespace nextview

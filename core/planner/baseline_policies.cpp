#include "core/planner/baseline_policies.hpp"

#include <algorithm>
#include <limits>

#include "core/planner/set_cover.hpp"
#include "core/random/counter_random.hpp"

namespace nextview {

Valuation SingleViewPolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                                   std::stop_token) const {
  std::vector<double> values;
  for (const std::size_t candidate : available) values.push_back(value(state, candidate));
  return values;
}

double RandomPolicy::value(const PlanningState& state, std::size_t candidate) const {
  const auto step = static_cast<std::uint32_t>(state.taken.size());
  return CounterRandom(state.seed, random_stream::random_planner, step).uniform(candidate)[0];
}

double FarthestPolicy::value(const PlanningState& state, std::size_t candidate) const {
  if (state.taken.empty()) return 0.0;
  double nearest = std::numeric_limits<double>::max();
  for (const TakenView& taken : state.taken)
    nearest = std::min(
        nearest,
        (taken.T_world_camera.translation() - state.candidates[candidate].T_world_camera.translation()).norm());
  return nearest;
}

double FixedOrderPolicy::value(const PlanningState& state, std::size_t candidate) const {
  return static_cast<double>(state.candidates.size() - candidate);
}

Valuation CoveringOrderPolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                                      std::stop_token) const {
  const auto order = state.true_surface->covering_order(state.seed);
  std::vector<double> values;
  for (const std::size_t candidate : available)
    values.push_back(static_cast<double>(order.end() - std::ranges::find(order, candidate)));
  return values;
}

Valuation SetCoverPolicy::values(const PlanningState& state, std::span<const std::size_t> available,
                                 std::stop_token) const {
  std::vector<std::vector<Covered>> unseen(available.size());
  std::vector<double> values;
  for (std::size_t i = 0; i < available.size(); ++i) {
    for (const std::uint32_t sample : state.true_surface->unseen_samples(available[i]))
      unseen[i].push_back({sample, 1});
    values.push_back(static_cast<double>(unseen[i].size()));
  }
  const auto all = static_cast<double>(state.true_surface->visible_samples());
  CoverLimits limits;  // as after each view it is looked for anew
  limits.fewest = available.size();
  for (const std::size_t i : least_cover(unseen, (1.0 - enough) * all, limits).views) values[i] += all;
  return values;
}

double OraclePolicy::value(const PlanningState& state, std::size_t candidate) const {
  return static_cast<double>(state.true_surface->new_samples(candidate));
}

}  // namespace nextview

#pragma once
#include "core/planner/policy.hpp"

namespace nextview {

/// Exercise: a policy of its own. A view is worth its height.
struct HighestFirstPolicy : Policy {
  std::string unit() const override { return "m"; }
  Valuation values(const PlanningState& state, std::span<const std::size_t> available, std::stop_token) const override {
    std::vector<double> values;
    for (const std::size_t v : available) values.push_back(1.0 + state.candidates[v].T_world_camera.translation().z());
    return values;
  }
  bool ignores_cost() const override { return true; }
};

}  // namespace nextview

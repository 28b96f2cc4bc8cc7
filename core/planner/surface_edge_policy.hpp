#pragma once
#include "core/planner/baseline_policies.hpp"

namespace nextview {

/// After the Surface Edge Explorer (Border, Gammell and Newman 2018): the surface goes on where the points that were
/// measured get fewer. A view is worth the sparse points (ScannedSurface) that it sees past what the map calls
/// occupied; theirs makes its own views for them, this one ranks the candidates that all policies have.
class SurfaceEdgePolicy : public BaselinePolicy {
 public:
  std::string unit() const override { return "points"; }
  Valuation values(const PlanningState& state, std::span<const std::size_t> available,
                   std::stop_token stop) const override;
};

}  // namespace nextview

#pragma once
#include <cmath>

#include "core/planner/planner.hpp"

namespace nextview {

/// Exercise: a candidate generator of its own. Its ring of views comes closer with every view that was taken.
struct CloserCandidates : CandidateGenerator {
  std::vector<View> candidates(const Knowledge& known) const override {
    const double radius = 1.0 - 0.1 * double(known.taken.size());
    std::vector<View> views;
    for (int i = 0; i < 8; ++i)
      views.push_back({look_at({radius * std::cos(i * 0.785), radius * std::sin(i * 0.785), 0.3}, Vector3::Zero())});
    return views;
  }
};

}  // namespace nextview

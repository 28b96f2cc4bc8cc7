#pragma once
#include <span>
#include <vector>

#include "core/planner/next_best_view.hpp"

namespace nextview {

enum class CandidateColumn { view, gain, cost, utility };

/// Candidates sorted by a column; equals stay in list order. Those that are not available come last.
std::vector<std::size_t> sorted_candidates(std::span<const Candidate> candidates, CandidateColumn column,
                                           bool ascending);

}  // namespace nextview

#include "ui/workbench/candidate_order.hpp"

#include <algorithm>
#include <numeric>

namespace nextview {

std::vector<std::size_t> sorted_candidates(std::span<const Candidate> candidates, CandidateColumn column,
                                           bool ascending) {
  const auto value = [&](std::size_t i) {
    switch (column) {
      case CandidateColumn::gain:
        return candidates[i].gain;
      case CandidateColumn::cost:
        return candidates[i].cost;
      case CandidateColumn::utility:
        return candidates[i].utility;
      case CandidateColumn::view:
        break;
    }
    return double(i);
  };
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (candidates[a].available != candidates[b].available) return candidates[a].available;
    return ascending ? value(a) < value(b) : value(a) > value(b);
  });
  return order;
}

}  // namespace nextview

#include "ui/workbench/session_snapshot.hpp"

#include <algorithm>
#include <set>

namespace nextview {

RefinementChange refinement_change(std::span<const Voxel> conventional, std::span<const Voxel> refined) {
  RefinementChange change;
  const auto bin = [&](float p) {
    return std::min(static_cast<std::size_t>(p * float(change.before.size())), change.before.size() - 1);
  };
  for (std::size_t v = 0; v < conventional.size(); ++v) {
    const Voxel &before = conventional[v], &after = refined[v];
    change.changed_class += before.voxel_class != after.voxel_class;
    change.entropy_before += before.entropy;
    change.entropy_after += after.entropy;
    if (!before.measured || !after.measured) continue;
    ++change.before[bin(before.probability)];
    ++change.after[bin(after.probability)];
  }
  return change;
}

std::size_t SessionSnapshot::views_on_branches() const {
  if (!timeline) return records.size();
  std::set<std::uint32_t> numbers;
  for (const Branch& branch : timeline->branches.all)
    for (const TimelineStep* step : timeline->line(branch)) numbers.insert(step->number);
  return numbers.size();
}

}  // namespace nextview

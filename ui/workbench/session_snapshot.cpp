#include "ui/workbench/session_snapshot.hpp"

#include <algorithm>

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

}  // namespace nextview

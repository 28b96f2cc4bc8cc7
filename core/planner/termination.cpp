#include "core/planner/termination.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace nextview {

void TerminationConfig::validate() const {
  if (views < 1 || views > 10'000)
    throw std::invalid_argument(fmt::format("termination: views must be from 1 to 10000, not {}", views));
  for (const auto& [name, share] :
       {std::pair{"coverage", coverage}, {"gain", gain}, {"new_voxels", new_voxels}, {"entropy_slope", entropy_slope}})
    if (!(share >= 0.0 && share <= 1.0))
      throw std::invalid_argument(
          fmt::format("termination: {} must be a share from 0 (off) to 1, not {}", name, share));
}

std::string termination_reason(const TerminationConfig& config, const ScanProgress& progress) {
  if (progress.views >= config.views) return fmt::format("{} views taken", progress.views);
  if (!progress.candidates_left) return "no candidate view is left";
  if (config.coverage > 0.0 && progress.coverage >= config.coverage)
    return fmt::format("coverage reached {:.1f} % of the visible surface", 100.0 * progress.coverage);
  if (config.gain > 0.0 && progress.best_gain <= config.gain * progress.first_gain)
    return fmt::format("the best gain left, {:.6g}, is at most {:g} of the first", progress.best_gain, config.gain);
  if (config.new_voxels > 0.0 && progress.new_voxel_share < config.new_voxels)
    return fmt::format("the last view measured only {:.3g} % of the region for the first time",
                       100.0 * progress.new_voxel_share);
  if (config.entropy_slope > 0.0 && progress.entropy_drop_share < config.entropy_slope)
    return fmt::format("the last view lowered the entropy by only {:.3g} %", 100.0 * progress.entropy_drop_share);
  return "";
}

}  // namespace nextview

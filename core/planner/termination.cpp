#include "core/planner/termination.hpp"

#include <fmt/format.h>

#include "core/setting/percent_text.hpp"

namespace nextview {

std::vector<Setting> settings(TerminationConfig& c) {
  return {
      {"termination.views", "", "stop after this many views", &c.views, from_to(1, TerminationConfig::max_views)},
      {"termination.surface_left", "",
       "stop when this share of the surface is expected to be left for the candidates, or less; 0: off",
       &c.surface_left, from_to(0, 1)},
      {"termination.coverage", "", "stop at this share of the visible surface; 0: off", &c.coverage, from_to(0, 1)},
      {"termination.gain", "", "stop when the best gain falls to this share of the first; 0: off", &c.gain,
       from_to(0, 1)},
      {"termination.new_voxels", "", "stop when a view measures less than this share of the region anew; 0: off",
       &c.new_voxels, from_to(0, 1)},
      {"termination.entropy_slope", "",
       "stop when a view lowers the unmeasured entropy by less than this share; 0: off", &c.entropy_slope,
       from_to(0, 1)},
  };
}

void TerminationConfig::validate() const { require_in_bounds(*this); }

std::string termination_reason(const TerminationConfig& config, const ScanProgress& progress) {
  if (progress.views >= config.views)
    return fmt::format("{} view{} taken", progress.views, progress.views == 1 ? "" : "s");
  if (!progress.candidates_left) return "no candidate view is left";
  if (config.surface_left > 0.0 && progress.surface_left && *progress.surface_left <= config.surface_left)
    return fmt::format("no view is worth it, {} of the surface is expected to be left",
                       percent_text(*progress.surface_left));
  if (config.coverage > 0.0 && progress.coverage >= config.coverage)
    return fmt::format("coverage reached {:.1f} % of the visible surface", 100.0 * progress.coverage);
  if (config.gain > 0.0 && progress.best_gain <= config.gain * progress.first_gain)
    return fmt::format("the best gain left, {:.6g}, is at most {:g} of the first", progress.best_gain, config.gain);
  if (config.new_voxels > 0.0 && progress.new_voxel_share < config.new_voxels)
    return fmt::format("the last view measured only {:.3g} % of the region for the first time",
                       100.0 * progress.new_voxel_share);
  if (config.entropy_slope > 0.0 && progress.entropy_drop_share < config.entropy_slope)
    return fmt::format("the last view lowered the unmeasured entropy by only {:.3g} %",
                       100.0 * progress.entropy_drop_share);
  return "";
}

}  // namespace nextview

#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/setting/setting.hpp"

namespace nextview {

/// When a scan is done. Each criterion but the number of views is off at 0.
struct TerminationConfig {
  static constexpr int max_views = 10000;  ///< as many as that are no limit

  int views = 20;              ///< after this many views
  double coverage = 0.0;       ///< surface coverage reached, of what can be seen, at d_reg
  double gain = 0.0;           ///< the best gain fell to this share of the first step's
  double new_voxels = 0.0;     ///< a view measured less than this share of the region's voxels for the first time
  double entropy_slope = 0.0;  ///< a view lowered the map's entropy (Eq. 18) by less than this share
  /// No more than this share of the surface is expected to be left for all views together; for planners that predict
  /// it.
  double surface_left = 0.005;

  /// Without any criterion.
  static TerminationConfig unlimited() { return {.views = max_views, .surface_left = 0.0}; }
  /// Whether at most the number of views ends the scan, as Continue leaves it.
  bool is_lifted() const {
    TerminationConfig lifted = unlimited();
    lifted.views = views;
    return *this == lifted;
  }
  bool operator==(const TerminationConfig&) const = default;
  bool limits_views() const { return views < max_views; }
  /// A scan with so many is within that limit; it may have more where the limit was lowered.
  bool limits_views(std::size_t taken) const { return limits_views() && taken <= static_cast<std::size_t>(views); }
  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
std::vector<Setting> settings(TerminationConfig& config);

/// How far a scan has come, as the criteria see it.
struct ScanProgress {
  int views = 0;
  double coverage = 0.0;                    ///< of visible surface
  double best_gain = 0.0;                   ///< of the candidates left
  double first_gain = 0.0;                  ///< best gain after the first view
  std::optional<double> surface_left = {};  ///< share that is expected; none: not predicted
  double new_voxel_share = 1.0;
  double entropy_drop_share = 1.0;
  bool candidates_left = true;
};

/// Why the scan is done, for people; empty while it is not.
std::string termination_reason(const TerminationConfig& config, const ScanProgress& progress);

}  // namespace nextview

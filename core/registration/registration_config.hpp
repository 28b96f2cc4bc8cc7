#pragma once
#include <vector>

#include "core/setting/setting.hpp"

namespace nextview {

/// Whether new scans are registered with those before, and what is done where that moves one far.
struct RegistrationConfig {
  enum class Mode { off, check, correct } mode = Mode::off;  ///< check: says so alone; correct: moves the scan
  enum class Beyond { ask, accept, reject } beyond_limits = Beyond::ask;  ///< without a window, ask rejects
  double max_shift = 0.0;      ///< of the scan's middle [m]; 0: by registration_limits
  double max_rotation = 0.0;   ///< [deg]; 0: likewise
  double min_overlap = 0.125;  ///< share of a scan's points that lie on what was scanned before

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
std::vector<Setting> settings(RegistrationConfig& config);

/// How far off a robot puts scans: standard deviations of a scan's middle [m], and of its turn [deg].
struct PoseErrors {
  double shift = 0.0, rotation = 0.0;
};

/// What register_scan goes by.
struct RegistrationLimits {
  double spacing = 0.005;     ///< between the points that are compared [m]
  double max_shift = 0.004;   ///< of the scan's middle [m]
  double max_rotation = 0.5;  ///< [deg]
  double min_overlap = 0.125;
  PoseErrors expected;  ///< of a scan before it is registered
};

/// The limits of a scan whose sensor has this noise along its rays [m] and whose map has voxels of this edge [m]. Where
/// the configuration sets none, check allows what good scans show, and correct what can be found, or what is known of
/// the robot. `known`: 0 where nothing is.
RegistrationLimits registration_limits(const RegistrationConfig& config, double range_noise, double resolution,
                                       const PoseErrors& known = {});

}  // namespace nextview

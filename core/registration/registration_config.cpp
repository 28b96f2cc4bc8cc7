#include "core/registration/registration_config.hpp"

#include <algorithm>

namespace nextview {

std::vector<Setting> settings(RegistrationConfig& c) {
  return {
      {"registration.mode", "",
       "compare each scan with those before it: check says where it lies off, correct moves it there",
       choice(c.mode, {"off", "check", "correct"})},
      {"registration.beyond_limits", "",
       "what happens to a scan that lies farther off than the limits; without a window, ask is reject",
       choice(c.beyond_limits, {"ask", "accept", "reject"})},
      {"registration.max_shift", "m", "how far the middle of a scan may lie off; 0: by the noise and the mode",
       &c.max_shift, zero_or(1e-5, 10)},
      {"registration.max_rotation", "deg", "how far a scan may be turned; 0: by the mode", &c.max_rotation,
       zero_or(1e-3, 180)},
      {"registration.min_overlap", "", "share of a scan's points that must lie on what was scanned before",
       &c.min_overlap, over_to(0, 1)},
  };
}

void RegistrationConfig::validate() const { require_in_bounds(*this); }

RegistrationLimits registration_limits(const RegistrationConfig& config, double range_noise, double resolution) {
  config.validate();
  const bool corrects = config.mode == RegistrationConfig::Mode::correct;
  RegistrationLimits limits;
  limits.spacing = std::max(0.5 * resolution, 2.0 * range_noise);
  const double check_shift = std::max(2.0 * range_noise, 0.5 * limits.spacing);
  limits.max_shift = config.max_shift > 0.0 ? config.max_shift : corrects ? 8.0 * limits.spacing : check_shift;
  limits.max_rotation = config.max_rotation > 0.0 ? config.max_rotation : corrects ? 5.0 : 1.0;
  limits.min_overlap = config.min_overlap;
  return limits;
}

}  // namespace nextview

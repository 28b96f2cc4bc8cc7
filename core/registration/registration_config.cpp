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
      {"registration.max_shift", "m",
       "how far the middle of a scan may lie off; 0: by the noise, the mode and what is known of the robot",
       &c.max_shift, zero_or(1e-5, 10)},
      {"registration.max_rotation", "deg",
       "how far a scan may be turned; 0: by the mode and what is known of the robot", &c.max_rotation,
       zero_or(1e-3, 180)},
      {"registration.min_overlap", "",
       "share of a scan's points that must lie on what was scanned before; correct takes views that promise four times "
       "that",
       &c.min_overlap, over_to(0, 1)},
  };
}

void RegistrationConfig::validate() const { require_in_bounds(*this); }

// Measured on 20 good scans of half a metre of a box, a sphere, a slotted housing and a slotted plate, with noise of 1
// and 2 mm at points 5 mm apart: those of the housing seemed to lie up to 0.5 mm and 0.1 deg off, those of the plate,
// of which only the thin sides tell where it lies, up to 0.9 times the noise. So twice the noise is beyond what good
// scans do, and half the spacing where there is less noise than spacing.
RegistrationLimits registration_limits(const RegistrationConfig& config, double range_noise, double resolution,
                                       const PoseErrors& known) {
  config.validate();
  const bool corrects = config.mode == RegistrationConfig::Mode::correct;
  RegistrationLimits limits;
  limits.spacing = std::max(0.5 * resolution, 2.0 * range_noise);
  const double good_shift = std::max(2.0 * range_noise, 0.5 * limits.spacing), good_rotation = 0.5;
  constexpr double deviations = 4.0;  // two scans' errors add up to more than one's
  const double found_shift = std::max(8.0 * limits.spacing, deviations * known.shift);  // pairs are looked for within 8
  const double found_rotation = known.rotation > 0.0 ? deviations * known.rotation : 5.0;
  limits.max_shift = corrects ? found_shift : good_shift;
  limits.max_rotation = corrects ? found_rotation : good_rotation;
  if (config.max_shift > 0.0) limits.max_shift = config.max_shift;
  if (config.max_rotation > 0.0) limits.max_rotation = config.max_rotation;
  // What check allows says how good scans should be, not how good they are.
  limits.expected = {(corrects ? limits.max_shift : found_shift) / deviations,
                     (corrects ? limits.max_rotation : found_rotation) / deviations};
  limits.min_overlap = config.min_overlap;
  return limits;
}

}  // namespace nextview

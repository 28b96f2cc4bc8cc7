#pragma once
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/registration/oriented_points.hpp"
#include "core/registration/registration_config.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// How a scan has to be moved to lie on those before it.
struct ScanRegistration {
  Pose T_corrected_believed = Pose::Identity();  ///< moves what is in the world [m]: a scan's points, its camera
  double shift = 0.0;                            ///< of the middle of the scan's points [m]
  double rotation = 0.0;                         ///< [rad]
  double overlap = 0.0;                          ///< share of the scan's points that lie on what was scanned before
  double residual_before = 0.0;  ///< of those points, root mean square distance to the surface there [m]
  double residual_after = 0.0;   ///< the same, once the scan is moved [m]
  int constrained = 6;           ///< directions of 6 that the shape tells; a plane tells 3. The others stay as believed
  bool reliable = false;         ///< else nothing is corrected
  std::string why_not;           ///< if it is not reliable
};

/// What scans are registered with, brought along from one to the next: the scans that have come since are added, and no
/// scan is gone through twice.
class RegistrationTarget {
 public:
  /// These scans' points, thinned together. Begins anew unless what it has are the first of them, as thin. @throws
  /// Stopped
  std::vector<OrientedPoint> of(std::span<const std::shared_ptr<const Scan>> scans, double spacing,
                                const std::stop_token& stop);

 private:
  std::vector<std::shared_ptr<const Scan>> scans_;
  double spacing_ = 0.0;  ///< [m]
  MergedPoints merged_{0.0};
};

/// Registers a scan with those before it, which have been corrected: iterative closest points to planes (Chen and
/// Medioni 1991), from far pairs to near ones, along the directions alone that the shape constrains (Zhang, Kaess and
/// Singh 2016), with the believed pose as a Gaussian prior of the expected errors. Sides of a thin wall are told apart
/// by where they were seen from. The same for the same input.
/// @throws std::invalid_argument if the spacing is not over 0; Stopped
ScanRegistration register_scan(const Scan& scan, std::span<const std::shared_ptr<const Scan>> so_far,
                               const RegistrationLimits& limits, const std::stop_token& stop = {});
/// The same, with a target that is brought along.
ScanRegistration register_scan(const Scan& scan, std::span<const std::shared_ptr<const Scan>> so_far,
                               const RegistrationLimits& limits, RegistrationTarget& target,
                               const std::stop_token& stop = {});

/// In what way a scan lies farther off than the limits allow, in one line; empty if it does not, or nothing is known.
std::string beyond_limits(const ScanRegistration& registration, const RegistrationLimits& limits);

/// A scan with its points and its camera moved.
Scan moved(const Scan& scan, const Pose& T_corrected_believed);

}  // namespace nextview

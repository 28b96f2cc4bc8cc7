#pragma once
#include <stop_token>
#include <string>
#include <vector>

#include "core/calibration/update_histories.hpp"
#include "core/progress/progress.hpp"

namespace nextview {

struct CalibrationConfig {
  bool clamps = true;            ///< fit clamp_min and clamp_max too
  bool range_dependent = false;  ///< fit the two decays too
  int iterations = 200;          ///< of one descent, at most
  /// @throws std::invalid_argument naming the field and its bounds.
  void validate() const;
};

/// A point of a descent.
struct CalibrationStep {
  double cross_entropy = 0.0;  ///< [nats per voxel]
  double gradient_norm = 0.0;  ///< by the parameters that BFGS sees
  InverseSensorModel model;
};

struct Calibration {
  InverseSensorModel model;
  double cross_entropy_before = 0.0;     ///< of the model that was given [nats per voxel]
  double cross_entropy = 0.0;            ///< of `model`; never more than before
  std::vector<CalibrationStep> descent;  ///< of the start that won, from that start to `model`
  std::string termination;               ///< which start won, and why its descent ended
  bool converged = false;                ///< that descent met a tolerance, with a gradient below 1e-5
};

/// Fits hit and miss, and as configured the clamps and the decays, to the histories' targets: the least cross entropy
/// that BFGS finds (Ceres). What is not fitted, and the bounds of the classes, stay those of `start`.
///
/// The log-odds' sizes are kept between 0.01 and those of p = 1e-4 and 1 - 1e-4, the clamps on their sides of
/// occupancy_threshold, the decays between -5 and 5 per m; a start beyond is taken from just inside. The function has
/// kinks where sums of terms meet a clamp, and plateaus where a single term does. So the descent is made from three
/// starts (the given one, half and twice its terms); one whose line search gives up goes on afresh from where it is, as
/// long as that helps. The same bytes on any number of threads.
///
/// A stop ends it early, with the best model so far.
/// @throws std::invalid_argument if there are no histories, the start or the configuration is not valid, or
///         occupancy_threshold is not between 0.001 and 0.999.
Calibration calibrate(const UpdateHistories& histories, const InverseSensorModel& start,
                      const CalibrationConfig& config = {}, const Progress& progress = {}, std::stop_token stop = {});

}  // namespace nextview

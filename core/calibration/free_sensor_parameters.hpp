#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/calibration/update_histories.hpp"

namespace nextview {

/// The numbers of an inverse sensor model that are fitted, as numbers free to take any value, so that a minimiser needs
/// to know of no bounds. Kept between bounds by a logistic function: the logarithms of the log-odds' sizes (0.01, to
/// those of p = 1e-4 and 1 - 1e-4; the clamps by 0.01 on their sides of occupancy_threshold), and the decays (-5 to 5
/// per m).
class FreeSensorParameters {
 public:
  /// hit and miss, and as told the clamps and the decays; the rest of a model stays that of `start`.
  /// @throws std::invalid_argument if its occupancy_threshold is not from 0.001 to 0.999.
  FreeSensorParameters(const InverseSensorModel& start, bool clamps, bool decays);

  std::size_t size() const { return fitted_.size(); }
  InverseSensorModel to_model(std::span<const double> free) const;
  /// Values beyond the bounds, or on them, are taken from just inside.
  std::vector<double> from_model(const InverseSensorModel& model) const;
  /// The names of what a model has at its bound: there the descent was stopped by the bound, not by the data.
  std::string at_bounds(const InverseSensorModel& model) const;
  /// The gradient by the free numbers that belongs to one by the model's, as CrossEntropy has it.
  std::vector<double> chain(std::span<const double> free, const std::array<double, sensor_parameters>& by_model) const;

 private:
  struct Fitted {
    SensorParameter parameter;
    double low, high;
    double value(double free) const;
    double slope(double free) const;
  };

  InverseSensorModel start_;
  std::vector<Fitted> fitted_;
};

}  // namespace nextview

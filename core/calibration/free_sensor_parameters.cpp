#include "core/calibration/free_sensor_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace nextview {
namespace {

using enum SensorParameter;

/// What a parameter is between its bounds: the logarithm of its log-odds' size, or the decay itself.
double bounded(const InverseSensorModel& model, SensorParameter parameter) {
  switch (parameter) {
    case hit:
      return std::log(log_odds(model.hit));
    case miss:
      return std::log(-log_odds(model.miss));
    case clamp_min:
      return std::log(-log_odds(model.clamp_min));
    case clamp_max:
      return std::log(log_odds(model.clamp_max));
    case hit_decay:
      return model.hit_decay;
    case miss_decay:
      return model.miss_decay;
  }
  throw std::invalid_argument("there is no such sensor parameter");
}

void set_bounded(InverseSensorModel& model, SensorParameter parameter, double value) {
  switch (parameter) {
    case hit:
      model.hit = probability(std::exp(value));
      break;
    case miss:
      model.miss = probability(-std::exp(value));
      break;
    case clamp_min:
      model.clamp_min = probability(-std::exp(value));
      break;
    case clamp_max:
      model.clamp_max = probability(std::exp(value));
      break;
    case hit_decay:
      model.hit_decay = value;
      break;
    case miss_decay:
      model.miss_decay = value;
      break;
  }
}

/// Of what CrossEntropy's gradient is by (log-odds or decay), by the bounded value.
double slope_of_log_odds(double bounded_value, SensorParameter parameter) {
  if (parameter == hit_decay || parameter == miss_decay) return 1.0;
  const bool negative = parameter == miss || parameter == clamp_min;
  return negative ? -std::exp(bounded_value) : std::exp(bounded_value);
}

}  // namespace

double FreeSensorParameters::Fitted::value(double free) const { return low + (high - low) * probability(free); }

double FreeSensorParameters::Fitted::slope(double free) const {
  return (high - low) * probability(free) * (1.0 - probability(free));
}

FreeSensorParameters::FreeSensorParameters(const InverseSensorModel& start, bool clamps, bool decays) : start_(start) {
  if (!(start.occupancy_threshold >= 0.001 && start.occupancy_threshold <= 0.999))
    throw std::invalid_argument("calibration: occupancy_threshold must be from 0.001 to 0.999");
  const double smallest = 0.01, largest = log_odds(1.0 - 1e-4), threshold = log_odds(start.occupancy_threshold);
  const auto fit = [&](SensorParameter parameter, double above) {
    fitted_.push_back({parameter, std::log(smallest + std::max(above, 0.0)), std::log(largest)});
  };
  fit(hit, 0.0);
  fit(miss, 0.0);
  if (clamps) fit(clamp_min, -threshold), fit(clamp_max, threshold);
  if (decays) fitted_.push_back({hit_decay, -5.0, 5.0}), fitted_.push_back({miss_decay, -5.0, 5.0});
}

InverseSensorModel FreeSensorParameters::to_model(std::span<const double> free) const {
  InverseSensorModel model = start_;
  for (std::size_t i = 0; i < size(); ++i) set_bounded(model, fitted_[i].parameter, fitted_[i].value(free[i]));
  return model;
}

std::vector<double> FreeSensorParameters::from_model(const InverseSensorModel& model) const {
  std::vector<double> free;
  for (const Fitted& f : fitted_) {
    const double share = (bounded(model, f.parameter) - f.low) / (f.high - f.low);
    free.push_back(log_odds(std::clamp(share, 1e-3, 1.0 - 1e-3)));
  }
  return free;
}

std::vector<double> FreeSensorParameters::chain(std::span<const double> free,
                                                const std::array<double, sensor_parameters>& by_model) const {
  std::vector<double> gradient;
  for (std::size_t i = 0; i < size(); ++i) {
    const Fitted& f = fitted_[i];
    gradient.push_back(by_model[static_cast<std::size_t>(f.parameter)] *
                       slope_of_log_odds(f.value(free[i]), f.parameter) * f.slope(free[i]));
  }
  return gradient;
}

std::string FreeSensorParameters::at_bounds(const InverseSensorModel& model) const {
  constexpr std::array names = {"hit", "miss", "clamp_min", "clamp_max", "hit_decay", "miss_decay"};
  std::string text;
  for (const Fitted& f : fitted_) {
    const double share = (bounded(model, f.parameter) - f.low) / (f.high - f.low);
    if (share < 0.001 || share > 0.999)
      text += (text.empty() ? "" : ", ") + std::string(names[static_cast<std::size_t>(f.parameter)]);
  }
  return text;
}

}  // namespace nextview

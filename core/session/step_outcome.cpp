#include "core/session/step_outcome.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nextview {
namespace {

/// Calls `take(name, value)` of all that is kept; a value is a reference, or an optional that may be empty.
template <class Record, class Take>
void each_value(Record& r, const Take& take) {
  take("step", r.step);
  take("view", r.view);
  take("overridden", r.overridden);
  take("distance", r.motion.distance);
  take("rotation", r.motion.rotation);
  take("seconds", r.motion.seconds);
  take("gain", r.gain);
  take("utility", r.utility);
  take("new_surface", r.new_surface);
  take("surface_left", r.surface_left);
  take("realised_gain", r.realised_gain);
  take("hits", r.hits);
  take("misses", r.misses);
  take("points", r.points);
  take("new_voxels", r.new_voxels);
  take("entropy", r.entropy);
  take("total_entropy", r.total_entropy);
  take("coverage", r.coverage);
  take("coverage_visible", r.coverage_visible);
  take("coverage_any_pose", r.coverage_any_pose);
  take("coverage_paper", r.coverage_paper);
  take("coverage_recorded", r.coverage_recorded);
  take("divergence", r.quality.divergence);
  take("log_loss", r.quality.log_loss);
  take("brier", r.quality.brier);
}

struct Writer {
  std::map<std::string, double>& outcome;

  template <class Value>
  void operator()(const char* name, const Value& value) const {
    outcome[name] = static_cast<double>(value);
  }
  void operator()(const char* name, const std::optional<double>& value) const {
    if (value) outcome[name] = *value;
  }
};

struct Reader {
  const std::map<std::string, double>& outcome;

  template <class Value>
  void operator()(const char* name, Value& value) const {
    if (const auto found = outcome.find(name); found != outcome.end()) set(value, found->second);
  }
  static void set(double& value, double number) { value = number; }
  static void set(std::optional<double>& value, double number) { value = number; }
  /// A file may say anything.
  template <class Whole>
  static void set(Whole& value, double number) {
    constexpr double most = std::numeric_limits<int>::max();
    value = static_cast<Whole>(
        std::clamp(std::isnan(number) ? 0.0 : number, std::is_same_v<Whole, int> ? -1.0 : 0.0, most));
  }
  static void set(bool& value, double number) { value = number != 0; }
};

}  // namespace

std::map<std::string, double> outcome_of(const StepRecord& record) {
  std::map<std::string, double> outcome;
  each_value(record, Writer{outcome});
  return outcome;
}

StepRecord record_with(const std::map<std::string, double>& outcome) {
  StepRecord record;
  each_value(record, Reader{outcome});
  return record;
}

}  // namespace nextview

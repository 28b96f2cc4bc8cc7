#include "core/calibration/sensor_model_calibration.hpp"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/calibration/free_sensor_parameters.hpp"

namespace nextview {
namespace {

/// What Ceres minimises.
class Objective : public ceres::FirstOrderFunction {
 public:
  Objective(const UpdateHistories& histories, const FreeSensorParameters& parameters, std::stop_token stop)
      : histories_(histories), parameters_(parameters), stop_(std::move(stop)) {}

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    if (stop_.stop_requested()) return false;
    const std::span<const double> free(parameters, parameters_.size());
    const InverseSensorModel model = parameters_.to_model(free);
    const CrossEntropy cross_entropy = histories_.cross_entropy(model);
    *cost = cross_entropy.value;
    if (gradient) std::ranges::copy(parameters_.chain(free, cross_entropy.gradient), gradient);
    return true;
  }
  int NumParameters() const override { return static_cast<int>(parameters_.size()); }

 private:
  const UpdateHistories& histories_;
  const FreeSensorParameters& parameters_;
  std::stop_token stop_;
};

/// Notes where a descent is, iteration by iteration.
class Recorder : public ceres::IterationCallback {
 public:
  Recorder(std::function<void(const ceres::IterationSummary&)> note, const std::stop_token& stop)
      : note_(std::move(note)), stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    note_(summary);
    return stop_.stop_requested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  std::function<void(const ceres::IterationSummary&)> note_;
  const std::stop_token& stop_;
};

struct Descent {
  std::vector<CalibrationStep> steps;
  std::string termination;
  bool converged = false;
};

ceres::GradientProblemSolver::Options solver_options(int iterations, ceres::IterationCallback& callback) {
  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::BFGS;
  options.line_search_type = ceres::WOLFE;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-11;
  options.gradient_tolerance = 1e-9;
  options.parameter_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;  // the callback reads it
  options.callbacks.push_back(&callback);
  return options;
}

/// Adds a point that Ceres does not tell its callback (a start, or where a tolerance was met), if it is the lowest.
void add_point(const ceres::GradientProblem& problem, const FreeSensorParameters& parameters,
               const std::vector<double>& free, Descent& descent) {
  double cost = 0.0;
  Eigen::VectorXd gradient(parameters.size());
  if (!problem.Evaluate(free.data(), &cost, gradient.data())) return;  // stopped
  if (descent.steps.empty() || cost < descent.steps.back().cross_entropy)
    descent.steps.push_back({cost, gradient.norm(), parameters.to_model(free)});
}

/// A step so short that it meets a tolerance proves a minimum only where the gradient vanishes.
void judge_kink(Descent& descent) {
  constexpr double vanished = 1e-5;
  if (!descent.converged || descent.steps.back().gradient_norm <= vanished) return;
  descent.converged = false;
  descent.termination += fmt::format(". It is at a kink, where sums of terms meet a clamp: gradient norm {:.2g}",
                                     descent.steps.back().gradient_norm);
}

/// BFGS from one start, again from where it ends until that no longer helps: at a kink its Hessian leads astray.
Descent descend(const UpdateHistories& histories, const FreeSensorParameters& parameters,
                const InverseSensorModel& start, int iterations, const std::function<void(int)>& report,
                const std::stop_token& stop) {
  constexpr double helped = 1e-8;  // share of the cross entropy
  std::vector<double> free = parameters.from_model(start);
  Descent descent;
  const auto note = [&](const ceres::IterationSummary& summary) {
    if (summary.iteration == 0) return;  // that point is there already
    descent.steps.push_back({summary.cost, summary.gradient_norm, parameters.to_model(free)});
    report(static_cast<int>(descent.steps.size()));
  };
  Recorder recorder(note, stop);
  const ceres::GradientProblem problem(new Objective(histories, parameters, stop));  // which owns it
  add_point(problem, parameters, free, descent);
  while (!stop.stop_requested()) {
    const int left = iterations + 1 - static_cast<int>(descent.steps.size());
    if (left <= 0) break;
    const double before = descent.steps.back().cross_entropy;
    ceres::GradientProblemSolver::Summary summary;
    ceres::Solve(solver_options(left, recorder), problem, free.data(), &summary);
    descent.termination = summary.message;  // some end with a full stop, some without
    if (descent.termination.ends_with('.')) descent.termination.pop_back();
    descent.converged = summary.termination_type == ceres::CONVERGENCE;
    if (descent.converged) add_point(problem, parameters, free, descent);
    if (!(descent.steps.back().cross_entropy < before * (1.0 - helped))) break;
  }
  judge_kink(descent);
  return descent;
}

struct Start {
  std::string_view name;
  double scale;  ///< of the log-odds of hit and miss
};
constexpr std::array<Start, 3> starts = {{{"the given terms", 1.0}, {"half the terms", 0.5}, {"twice the terms", 2.0}}};

InverseSensorModel with_scaled_terms(InverseSensorModel model, double scale) {
  model.hit = probability(scale * log_odds(model.hit));
  model.miss = probability(scale * log_odds(model.miss));
  return model;
}

}  // namespace

void CalibrationConfig::validate() const {
  if (iterations < 1 || iterations > 100'000)
    throw std::invalid_argument(fmt::format("calibration: iterations must be from 1 to 100000, not {}", iterations));
}

Calibration calibrate(const UpdateHistories& all, const InverseSensorModel& start, const CalibrationConfig& config,
                      const Progress& progress, std::stop_token stop) {
  config.validate();
  start.validate();
  const bool ranges_matter = config.range_dependent || start.range_dependent();
  const UpdateHistories merged = ranges_matter ? UpdateHistories() : all.without_ranges();
  const UpdateHistories& histories = ranges_matter ? all : merged;
  const FreeSensorParameters parameters(start, config.clamps, config.range_dependent);

  Calibration result;
  result.model = start;
  result.cross_entropy = result.cross_entropy_before = histories.cross_entropy(start).value;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const auto report = [&](int step) {
      const double of_descent = std::min(1.0, double(step) / config.iterations);
      if (progress) progress((double(s) + of_descent) / starts.size(), "fitting the inverse sensor model");
    };
    Descent descent =
        descend(histories, parameters, with_scaled_terms(start, starts[s].scale), config.iterations, report, stop);
    if (descent.steps.empty()) continue;
    const CalibrationStep& last = descent.steps.back();
    const bool lower = last.cross_entropy < result.cross_entropy;
    if (!lower && s > 0) continue;
    if (lower) {
      result.model = last.model;
      result.cross_entropy = last.cross_entropy;
    }
    result.termination = fmt::format("from {}: {}", starts[s].name, descent.termination);
    result.converged = descent.converged;
    result.descent = std::move(descent.steps);
  }
  if (const std::string bounds = parameters.at_bounds(result.model); !bounds.empty())
    result.termination += fmt::format(". At the bounds of what is tried: {}", bounds);
  if (stop.stop_requested()) result.termination = "stopped", result.converged = false;
  return result;
}

}  // namespace nextview

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "tests/benchmarks/planning_step.hpp"

namespace nextview {
namespace {

/// What is timed of a step.
struct Stage {
  std::string_view name;
  void (*run)(PlanningStep&);
};
constexpr std::array<Stage, 3> stages = {{{"insert", [](PlanningStep& s) { s.insert(); }},
                                          {"score, occlusion-aware", [](PlanningStep& s) { s.score(); }},
                                          {"score, new-surface", [](PlanningStep& s) { s.score_new_surface(); }}}};

/// One size that grows, others as by default.
struct Growth {
  std::string_view of;
  std::vector<double> sizes;
  PlanningStepSize (*step)(double size);
};

const std::vector<Growth>& all_growth() {
  static const std::vector<Growth> all = {
      {"voxels along an edge", {64, 128, 256, 512}, [](double n) { return PlanningStepSize{.resolution = 1.28 / n}; }},
      {"pixels",
       {160 * 120, 320 * 240, 640 * 480, 1280 * 960},
       [](double n) { return PlanningStepSize{.width = int(std::lround(std::sqrt(n * 4 / 3)))}; }},
      {"candidates", {24, 48, 96, 192}, [](double n) { return PlanningStepSize{.candidates = int(n)}; }},
      {"views before", {1, 5, 10, 20}, [](double n) { return PlanningStepSize{.views_before = int(n)}; }}};
  return all;
}

/// The slope of log y over log x, by least squares.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    n += 1, sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void print(const Growth& growth, int rounds) {
  std::array<std::vector<double>, stages.size()> times;
  std::vector<double> megabytes;
  for (const double size : growth.sizes) {
    PlanningStep step(growth.step(size));
    megabytes.push_back(1e-6 * double(step.map.voxels().bytes()));
    for (std::size_t s = 0; s < stages.size(); ++s) {
      LeastTime least;
      for (int round = 0; round < 3 * rounds; ++round) least.keep([&] { stages[s].run(step); });
      times[s].push_back(least.waited);
    }
  }
  const auto row = [](std::string_view name, const std::vector<double>& values) {
    fmt::print("  {:<26}", name);
    for (const double value : values) fmt::print("{:>12.4g}", value);
  };
  row(growth.of, growth.sizes);
  fmt::print("{:>12}\n", "exponent");
  for (std::size_t s = 0; s < stages.size(); ++s) {
    row(fmt::format("{} [ms]", stages[s].name), times[s]);
    fmt::print("{:>12.2f}\n", exponent(growth.sizes, times[s]));
  }
  row("the map [MB]", megabytes);
  fmt::print("{:>12.2f}\n\n", exponent(growth.sizes, megabytes));
}

}  // namespace

void print_growth(int rounds) {
  fmt::print("How a planning step grows: time is proportional to size to the power of the exponent\n\n");
  for (const Growth& growth : all_growth()) print(growth, rounds);
}

}  // namespace nextview

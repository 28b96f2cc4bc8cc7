// The bar: on every test problem the sampler's marginals are those of the exact posterior, whatever the moves.
#include "core/gibbs/posterior_sampler.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "tests/unit/gibbs/marginal_comparison.hpp"
#include "tests/unit/gibbs/plain_model.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using random_problems::Problem;
using random_problems::Shape;

constexpr double largest_standard_error = 0.003;  // far below the bar
constexpr int most_sweeps = 128'000;

Estimate sample(const Problem& problem, const PosteriorSamplerConfig& config) {
  const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config);
  return {{posterior.occupied.begin(), posterior.occupied.end()},
          {posterior.upper.begin(), posterior.upper.end()},
          posterior.informed};
}

/// Compares the mean of runs that differ in their seed alone: their spread shows the Monte-Carlo error, whatever the
/// sampler says of itself. As many sweeps as it takes to have the error far below the bar: how many those are, a first
/// try shows.
MarginalComparison compare_runs(const plain::Marginals& exact, const Problem& problem, PosteriorSamplerConfig config) {
  MarginalComparison comparison;
  for (config.sweeps = 4'000;;) {
    config.burn_in = config.sweeps / 20;
    std::vector<Estimate> runs;
    for (config.seed = 1; config.seed <= 8; ++config.seed) runs.push_back(sample(problem, config));
    comparison = compare(exact, runs);
    if (comparison.standard_error < largest_standard_error || config.sweeps == most_sweeps) return comparison;
    const double times = std::pow(comparison.standard_error / largest_standard_error, 2);
    config.sweeps = std::min(config.sweeps * std::clamp(static_cast<int>(std::ceil(1.1 * times)), 2, 4), most_sweeps);
  }
}

struct Case {
  Shape shape;
  ForwardModel model;
  double prior;
  bool centre_ranges;
  std::uint64_t seed;
  double independence = 1.0;

  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.shape.name << ", " << name(c.model); }
};

/// Every test problem with every model; priors, ranges and what rays count go round. A prior of 0.5 is the paper's zero
/// log-odds.
std::vector<Case> cases() {
  std::vector<Case> list;
  std::uint64_t seed = 0;
  for (const Shape& shape : random_problems::small())
    for (const ForwardModel model :
         {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam, ForwardModel::attenuation}) {
      ++seed;
      list.push_back({shape, model, std::array{0.1, 0.5, 0.03, 0.25}[(seed + seed / 4) % 4], seed % 3 == 0, seed,
                      seed / 4 % 2 == 0 ? 1.0 : 0.35});
    }
  for (const Shape& shape : random_problems::large()) {
    list.push_back({shape, ForwardModel::beam, 0.1, false, ++seed});
    list.push_back({shape, ForwardModel::paper, 0.3, true, ++seed});
  }
  return list;
}

class SamplerOnProblems : public ::testing::TestWithParam<Case> {};

TEST_P(SamplerOnProblems, marginalsAreThoseOfTheExactPosterior) {
  const Case& c = GetParam();
  const Problem problem = random_problems::make(c.shape, c.seed);
  const ForwardSensorModel model =
      model_for(problem, c.model, c.centre_ranges ? VoxelRange::centre : VoxelRange::segment, c.independence);
  const plain::Marginals exact = plain::enumerate(plain::Posterior(problem.grid, problem.measurements, model, c.prior));
  for (const int swaps : {0, 1})
    for (const int plaquettes : {0, 1}) {
      if (plaquettes == 1 && c.shape.size.y() == 1) continue;  // a corridor has none
      PosteriorSamplerConfig config;
      config.model = model;
      config.prior = c.prior;
      config.swaps = swaps, config.plaquettes = plaquettes;
      config.start = std::array{StartMap::free, StartMap::occupied, StartMap::random}[c.seed % 3];
      config.chains = 2;
      config.until_stationary = false;
      config.ray_spacing = 0.0;
      const MarginalComparison comparison = compare_runs(exact, problem, config);
      const std::string what = fmt::format("swaps {}, plaquettes {}: {}", swaps, plaquettes, comparison.text());
      fmt::print("             {}\n", what);
      EXPECT_TRUE(comparison.agrees()) << what;
      EXPECT_LT(comparison.standard_error, largest_standard_error) << what;
    }
}

INSTANTIATE_TEST_SUITE_P(Problems, SamplerOnProblems, ::testing::ValuesIn(cases()), [](const auto& parameter) {
  std::string text = parameter.param.shape.name + " " + std::string(name(parameter.param.model));
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
});

}  // namespace
}  // namespace nextview

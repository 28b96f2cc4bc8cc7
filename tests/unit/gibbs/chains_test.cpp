// The chains of one run: independent of each other, each with numbers of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/gibbs/posterior_sampler.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using random_problems::Problem;
using random_problems::room;

PosteriorSamplerConfig four_chains(const Problem& problem, ForwardModel kind) {
  PosteriorSamplerConfig config;
  config.model.kind = kind;
  config.model.sigma = problem.sigma;
  config.model.angular_sigma = 0.3;
  config.model.attenuations = {0.3, 2.0};
  config.prior = 0.3;
  config.chains = 4;
  config.sweeps = 4, config.burn_in = 0;
  config.until_stationary = false;
  config.ray_spacing = 0.0;
  return config;
}

bool all_differ(const std::vector<std::vector<std::uint8_t>>& states) {
  for (std::size_t a = 0; a < states.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (std::equal(states[a].begin(), states[a].end(), states[b].begin())) return false;
  return states.size() == 4;
}

// From one start: what differs is what each chain drew.
TEST(Chains, FromOneStartDifferAfterASweep) {
  const Problem problem = room();
  for (const ForwardModel kind :
       {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam, ForwardModel::attenuation})
    for (const StartMap start : {StartMap::free, StartMap::occupied})
      for (const Sampler sampler : {Sampler::exact, Sampler::algorithm1}) {
        PosteriorSamplerConfig config = four_chains(problem, kind);
        config.start = start;
        config.sampler = sampler;
        const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config);
        const SamplerDiagnostics& d = posterior.diagnostics;
        std::set<double> after_one_sweep;
        for (const auto& trace : d.log_posterior) after_one_sweep.insert(trace.at(0));
        EXPECT_EQ(after_one_sweep.size(), 4u) << name(kind) << ": chains drew the same numbers";
        EXPECT_TRUE(all_differ(posterior.states)) << name(kind);
      }
}

// Chains that start from the same warm map part at once, too.
TEST(Chains, FromOneWarmMapDifferAfterASweep) {
  const Problem problem = room();
  const PosteriorSamplerConfig config = four_chains(problem, ForwardModel::attenuation);
  const std::vector<std::vector<std::uint8_t>> warm(4, std::vector<std::uint8_t>(problem.grid.voxel_count(), 1));
  const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config, {}, {warm});
  EXPECT_TRUE(all_differ(posterior.states));
}

// A chain draws the same whatever chains run beside it, and every sweep anew.
TEST(Chains, DoNotDependOnTheirNumber) {
  const Problem problem = room();
  PosteriorSamplerConfig config = four_chains(problem, ForwardModel::attenuation);
  const GibbsPosterior four = sample_posterior(problem.grid, problem.measurements, config);
  config.chains = 2;
  const GibbsPosterior two = sample_posterior(problem.grid, problem.measurements, config);
  for (int c = 0; c < 2; ++c) {
    EXPECT_EQ(two.states[c], four.states[c]);
    EXPECT_EQ(two.diagnostics.log_posterior[c], four.diagnostics.log_posterior[c]);
  }
}

// The posterior is the mean over all chains, each with the same weight.
TEST(Chains, AllCountInTheMean) {
  const Problem problem = room();
  PosteriorSamplerConfig config = four_chains(problem, ForwardModel::beam);
  config.sweeps = 40, config.start = StartMap::random;
  config.chains = 1;
  const GibbsPosterior one = sample_posterior(problem.grid, problem.measurements, config);
  config.chains = 2;
  const GibbsPosterior two = sample_posterior(problem.grid, problem.measurements, config);
  config.chains = 3;
  const GibbsPosterior three = sample_posterior(problem.grid, problem.measurements, config);
  double second = 0.0, third = 0.0;  // what each alone must have had, taken apart
  std::size_t differing = 0;
  for (std::size_t v = 0; v < one.occupied.size(); ++v) {
    if (!one.informed[v] || !two.informed[v] || !three.informed[v]) continue;
    const double b = 2.0 * two.occupied[v] - one.occupied[v], c = 3.0 * three.occupied[v] - 2.0 * two.occupied[v];
    ASSERT_GE(std::min(b, c), -1e-5);
    ASSERT_LE(std::max(b, c), 1.0 + 1e-5);
    second += b, third += c;
    differing += std::abs(b - one.occupied[v]) > 0.01 && std::abs(c - b) > 0.01;
  }
  EXPECT_GT(differing, 5u);
  EXPECT_GT(second, 1.0);
  EXPECT_GT(third, 1.0);
}

}  // namespace
}  // namespace nextview

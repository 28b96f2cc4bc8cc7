// What a run of the sampler tells and keeps for those who look into it.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/gibbs/posterior_sampler.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using random_problems::Problem;
using random_problems::room;

PosteriorSamplerConfig three_chains(const Problem& problem, ForwardModel kind = ForwardModel::attenuation) {
  PosteriorSamplerConfig config;
  config.model.kind = kind;
  config.model.sigma = problem.sigma;
  config.model.attenuations = {0.3, 2.0};
  config.sweeps = 60, config.burn_in = 7, config.chains = 3;
  config.until_stationary = false;
  config.ray_spacing = 0.0;
  return config;
}

TEST(LevelTraces, ChangeNoResult) {
  const Problem problem = room();
  for (const ForwardModel kind : {ForwardModel::beam, ForwardModel::attenuation, ForwardModel::cone}) {
    PosteriorSamplerConfig config = three_chains(problem, kind);
    const GibbsPosterior without = sample_posterior(problem.grid, problem.measurements, config);
    config.keep_traces = true;
    const GibbsPosterior with = sample_posterior(problem.grid, problem.measurements, config);
    EXPECT_EQ(with.occupied, without.occupied);
    EXPECT_EQ(with.upper, without.upper);
    EXPECT_EQ(with.informed, without.informed);
    EXPECT_EQ(with.states, without.states);
    EXPECT_EQ(with.diagnostics.log_posterior, without.diagnostics.log_posterior);
    EXPECT_TRUE(without.traces.voxels.empty() && without.traces.levels.empty());
    EXPECT_FALSE(with.traces.voxels.empty());
  }
}

TEST(LevelTraces, AreTheChainsLevelsOfTheMeansSweeps) {
  const Problem problem = room();
  PosteriorSamplerConfig config = three_chains(problem);
  config.keep_traces = true;
  config.sweeps = 2007;
  const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config);
  const LevelTraces& traces = posterior.traces;
  EXPECT_EQ(traces.dropped, 0u);
  ASSERT_TRUE(std::is_sorted(traces.voxels.begin(), traces.voxels.end()));
  ASSERT_GT(traces.voxels.size(), 50u);
  ASSERT_EQ(traces.levels.size(), 3u);
  double largest = 0.0;
  for (std::size_t k = 0; k < traces.voxels.size(); ++k) {
    double occupied = 0.0, upper = 0.0;
    for (int c = 0; c < 3; ++c) {
      ASSERT_EQ(traces.levels[c].size(), 2000u);
      for (const auto& sweep : traces.levels[c]) occupied += sweep[k] > 0, upper += sweep[k] == 2;
      EXPECT_EQ(traces.levels[c].back()[k], posterior.states[c][traces.voxels[k]]) << "the last sweep is the state";
    }
    if (!posterior.informed[traces.voxels[k]]) continue;
    // Counting levels and averaging conditionals (Rao-Blackwell) estimate the same.
    largest = std::max(largest, std::abs(occupied / 6000 - posterior.occupied[traces.voxels[k]]));
    largest = std::max(largest, std::abs(upper / 6000 - posterior.upper[traces.voxels[k]]));
  }
  EXPECT_LT(largest, 0.06);
}

TEST(LevelTraces, DropTheOldestSweepsBeyondTheirMemory) {
  const Problem problem = room();
  PosteriorSamplerConfig config = three_chains(problem);
  config.keep_traces = true;
  const LevelTraces all = sample_posterior(problem.grid, problem.measurements, config).traces;
  config.max_trace_bytes = 20 * 3 * all.voxels.size() + 5;
  const LevelTraces some = sample_posterior(problem.grid, problem.measurements, config).traces;
  EXPECT_EQ(all.dropped, 0u);
  ASSERT_EQ(all.levels[0].size(), 53u);
  EXPECT_EQ(some.dropped, 33u);
  for (int c = 0; c < 3; ++c) {
    ASSERT_EQ(some.levels[c].size(), 20u);
    EXPECT_TRUE(std::equal(some.levels[c].begin(), some.levels[c].end(), all.levels[c].begin() + 33));
  }
  config.max_trace_bytes = 10;
  const LevelTraces none = sample_posterior(problem.grid, problem.measurements, config).traces;
  EXPECT_EQ(none.dropped, 53u);
  EXPECT_TRUE(none.levels[0].empty());
}

TEST(LevelTraces, OfAStationaryRunAreThoseOfItsLastMean) {
  const Problem problem = room();
  PosteriorSamplerConfig config = three_chains(problem);
  config.keep_traces = config.until_stationary = true;
  config.sweeps = 4000;
  const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config);
  const SamplerDiagnostics& d = posterior.diagnostics;
  EXPECT_EQ(posterior.traces.levels[0].size() + posterior.traces.dropped, std::size_t(d.sweeps - d.burn_in));
}

TEST(SamplerProgress, ShowsTheTracesUpToNow) {
  const Problem problem = room();
  const PosteriorSamplerConfig config = three_chains(problem);
  std::vector<int> sweeps;
  std::vector<double> trace;
  const auto look = [&](double fraction, std::string_view, const SamplerDiagnostics& so_far) {
    EXPECT_NEAR(fraction, so_far.sweeps / 60.0, 1e-12);
    sweeps.push_back(so_far.sweeps);
    if (so_far.sweeps == 0) return;
    ASSERT_EQ(so_far.log_posterior.size(), 3u);
    for (int c = 0; c < 3; ++c) {
      ASSERT_EQ(so_far.log_posterior[c].size(), std::size_t(so_far.sweeps));
      ASSERT_EQ(so_far.changed_voxels[c].size(), std::size_t(so_far.sweeps));
    }
    EXPECT_GT(so_far.merged_rays, 500u);
    EXPECT_EQ(so_far.burn_in, so_far.sweeps > 7 ? 7 : so_far.burn_in);
    trace = so_far.log_posterior[1];
  };
  const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config, {}, {}, look);
  EXPECT_TRUE(std::is_sorted(sweeps.begin(), sweeps.end()));
  EXPECT_EQ(sweeps.front(), 0);
  EXPECT_EQ(sweeps.back(), 60) << "the last call has all of it";
  for (std::size_t k = 1; k < sweeps.size(); ++k) EXPECT_LE(sweeps[k] - sweeps[k - 1], 4);
  EXPECT_EQ(trace, posterior.diagnostics.log_posterior[1]);
}

}  // namespace
}  // namespace nextview

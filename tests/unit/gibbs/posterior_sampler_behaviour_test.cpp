// What the sampler promises beside the right marginals: reproducible, independent of its start, honest of what it does
// not know.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/gibbs/independence.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/gibbs/sites.hpp"
#include "tests/unit/gibbs/marginal_comparison.hpp"
#include "tests/unit/gibbs/plain_model.hpp"
#include "tests/unit/gibbs/random_problems.hpp"
#include "tests/unit/gibbs/tested_values.hpp"

namespace nextview {
namespace {

using random_problems::Problem;
using random_problems::room;

PosteriorSamplerConfig config_for(const Problem& problem, ForwardModel kind) {
  PosteriorSamplerConfig config;
  config.model.kind = kind;
  config.model.sigma = problem.sigma;
  config.model.angular_sigma = 0.3;
  config.model.attenuations = {0.3, 2.0};
  config.sweeps = 2'000, config.burn_in = 100;
  config.until_stationary = false;
  config.ray_spacing = 0.0;
  return config;
}

TEST(PosteriorSampler, theSameBytesOnAnyNumberOfThreads) {
  const Problem problem = room();
  for (const ForwardModel kind : every_model) {
    PosteriorSamplerConfig config = config_for(problem, kind);
    config.sweeps = 40, config.burn_in = 5, config.chains = 4;
    config.model.independence = 0.0;
    std::vector<GibbsPosterior> posteriors;
    for (const std::size_t threads : {1, 2, 2}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      posteriors.push_back(sample_posterior(problem.grid, problem.measurements, config));
    }
    for (const GibbsPosterior& other : posteriors) {
      EXPECT_EQ(other.occupied, posteriors[0].occupied) << name(kind);
      EXPECT_EQ(other.upper, posteriors[0].upper);
      EXPECT_EQ(other.touch, posteriors[0].touch);
      EXPECT_EQ(other.centre, posteriors[0].centre);
      EXPECT_EQ(other.informed, posteriors[0].informed);
      EXPECT_EQ(other.states, posteriors[0].states);
      EXPECT_EQ(other.diagnostics.log_posterior, posteriors[0].diagnostics.log_posterior);
    }
    config.seed = 2;
    EXPECT_NE(sample_posterior(problem.grid, problem.measurements, config).occupied, posteriors[0].occupied)
        << name(kind);
  }
}

/// Largest difference between two posteriors where both are informed.
double difference(const GibbsPosterior& a, const GibbsPosterior& b) {
  double largest = 0.0;
  for (std::size_t voxel = 0; voxel < a.occupied.size(); ++voxel)
    if (a.informed[voxel] && b.informed[voxel])
      largest = std::max<double>(largest, std::abs(a.occupied[voxel] - b.occupied[voxel]));
  return largest;
}

TEST(PosteriorSampler, everyStartLeadsToTheSamePosterior) {
  const Problem problem = random_problems::make({"oblong", {4, 3, 1}, 2, 8, 0.8}, 21);
  const std::vector<float> start_map(problem.grid.voxel_count(), 0.7f);
  for (const ForwardModel kind : {ForwardModel::beam, ForwardModel::attenuation}) {
    PosteriorSamplerConfig config = config_for(problem, kind);
    config.sweeps = 20'000;
    config.start = StartMap::free;
    const GibbsPosterior cold = sample_posterior(problem.grid, problem.measurements, config);
    EXPECT_GT(std::count(cold.informed.begin(), cold.informed.end(), 1), 4);
    for (const StartMap start : {StartMap::octree, StartMap::occupied, StartMap::random}) {
      config.start = start;
      config.seed = 10 + static_cast<int>(start);
      EXPECT_LT(difference(cold, sample_posterior(problem.grid, problem.measurements, config, start_map)), 0.02)
          << name(kind);
    }
    const GibbsPosterior warm = sample_posterior(problem.grid, problem.measurements, config, {}, {cold.states});
    EXPECT_LT(difference(cold, warm), 0.02) << name(kind);
  }
}

TEST(PosteriorSampler, aWarmStartTakesThePlaceOfTheStartAndOfHalfTheBurnIn) {
  const Problem problem = room();
  PosteriorSamplerConfig config = config_for(problem, ForwardModel::attenuation);
  config.sweeps = 60, config.burn_in = 30;
  const GibbsPosterior cold = sample_posterior(problem.grid, problem.measurements, config);
  ASSERT_EQ(cold.states.size(), 2u);
  const GibbsPosterior warm = sample_posterior(problem.grid, problem.measurements, config, {}, {cold.states});
  ASSERT_FALSE(warm.diagnostics.log_posterior.empty());
  EXPECT_EQ(cold.diagnostics.burn_in, 30);
  EXPECT_EQ(warm.diagnostics.burn_in, 15);
  // The warm chain begins at the level at which the cold one ended, far from where that began.
  const std::vector<double>& before = cold.diagnostics.log_posterior[0];
  const double settled = before.back(), first = warm.diagnostics.log_posterior[0].front();
  EXPECT_LT(std::abs(first - settled), 0.3 * std::abs(before.front() - settled) + 30.0);
}

TEST(PosteriorSampler, KeepsWhatNoLaterRayPassesAndNoRayEndsNear) {
  Problem problem = random_problems::make({"large room", {12, 11, 10}, 3, 60, 0.2}, 7);
  std::ranges::stable_sort(problem.measurements.rays, {}, &RangeMeasurement::origin);
  for (const ForwardModel kind : every_model) {
    PosteriorSamplerConfig config = config_for(problem, kind);
    config.sweeps = 40, config.until_stationary = false;
    const GibbsPosterior earlier = sample_posterior(problem.grid, problem.measurements, config);
    const RayLists lists(problem.grid, problem.measurements,
                         with_independence(config.model, problem.measurements, problem.grid));
    config.seed = 99;
    const GibbsPosterior all = sample_posterior(lists, config, {}, {earlier.states});
    const GibbsPosterior kept_none = sample_posterior(lists, config, {}, {earlier.states, &earlier, 0});
    EXPECT_EQ(kept_none.occupied, all.occupied) << name(kind) << ": all are passed by a ray from the first on";
    EXPECT_EQ(kept_none.touch, all.touch);
    EXPECT_EQ(kept_none.informed, all.informed);
    EXPECT_EQ(kept_none.states, all.states);

    const std::uint32_t first = lists.first_ray_of(2);
    const GibbsPosterior kept = sample_posterior(lists, config, {}, {earlier.states, &earlier, first});
    const Sites sites = find_sites(lists, config, {}, first);
    std::size_t changed = 0, stayed = 0;
    for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
      if (sites.kind[v] != Sites::none) {
        changed += kept.occupied[v] != earlier.occupied[v];
        continue;
      }
      stayed += lists.observed(v);
      EXPECT_EQ(kept.occupied[v], earlier.occupied[v]) << v;
      EXPECT_EQ(kept.upper[v], earlier.upper[v]) << v;
      EXPECT_EQ(kept.informed[v], earlier.informed[v]) << v;
      EXPECT_EQ(kept.touch[v], earlier.touch[v]) << v;
      EXPECT_EQ(kept.centre[v], earlier.centre[v]) << v;
      for (std::size_t c = 0; c < kept.states.size(); ++c) EXPECT_EQ(kept.states[c][v], earlier.states[c][v]) << v;
    }
    EXPECT_GT(changed, 30u) << name(kind);
    EXPECT_EQ(stayed > 0, !lists.model().is_first_hit()) << "in first-hit models all voxels are near";
  }
}

TEST(PosteriorSampler, OfFewSweepsNothingIsSaid) {
  const Problem problem = room();
  PosteriorSamplerConfig config = config_for(problem, ForwardModel::attenuation);
  config.burn_in = 1, config.until_stationary = false;
  for (const int in_mean : {4, 9, 10}) {
    config.sweeps = config.burn_in + in_mean;
    const SamplerDiagnostics d = sample_posterior(problem.grid, problem.measurements, config).diagnostics;
    EXPECT_EQ(d.warning.find("too few to tell") != std::string::npos, in_mean < 10) << d.warning;
    EXPECT_TRUE(in_mean >= 10 || !d.stationary) << in_mean;
  }
}

TEST(PosteriorSampler, updatingOccupiedVoxelsLeavesFreeOnesAlone) {
  const Problem problem = random_problems::make({"oblong", {4, 3, 1}, 2, 10, 0.8}, 22);
  std::vector<float> start_map(problem.grid.voxel_count(), 0.2f);
  for (const int voxel : {1, 5, 6, 10}) start_map[voxel] = 0.9f;
  for (const ForwardModel kind : every_model) {
    PosteriorSamplerConfig config = config_for(problem, kind);
    config.updated = UpdatedVoxels::occupied;
    config.prior = 0.5;
    config.sweeps = 500;
    const auto expect_free_ones_free = [&](const GibbsPosterior& posterior) {
      for (const auto& state : posterior.states)
        for (std::size_t voxel = 0; voxel < state.size(); ++voxel)
          ASSERT_TRUE(start_map[voxel] > 0.5f || state[voxel] == 0) << name(kind) << ", voxel " << voxel;
    };
    for (const StartMap start : {StartMap::free, StartMap::occupied, StartMap::random}) {
      config.start = start;
      expect_free_ones_free(sample_posterior(problem.grid, problem.measurements, config, start_map));
    }
    config.start = StartMap::octree;
    const std::vector warm(2, std::vector<std::uint8_t>(start_map.size(), 1));  // of a map that knew less
    expect_free_ones_free(sample_posterior(problem.grid, problem.measurements, config, start_map, {warm}));
    const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config, start_map);
    expect_free_ones_free(posterior);
    for (std::size_t voxel = 0; voxel < start_map.size(); ++voxel)
      EXPECT_TRUE(start_map[voxel] > 0.5f || !posterior.informed[voxel] || posterior.occupied[voxel] == 0.2f)
          << "voxel " << voxel << " does not keep what the start map said, but reads " << posterior.occupied[voxel];
  }
}

/// Both as in Algorithm 1; the order in which voxels are drawn, and so the chain, need not be the same, but is here.
void expect_plain_algorithm1(const Problem& problem, ForwardModel kind, double sigma) {
  PosteriorSamplerConfig config = config_for(problem, kind);
  config.model.sigma = sigma;
  config.sampler = Sampler::algorithm1;
  config.prior = 0.5;
  config.swaps = config.plaquettes = 0;
  config.sweeps = 20'000;
  const GibbsPosterior sampled = sample_posterior(problem.grid, problem.measurements, config);
  const plain::Posterior posterior(problem.grid, problem.measurements, config.model, config.prior);
  const plain::Marginals plain =
      plain::gibbs_sampler(posterior, plain::thresholded_conditional(posterior), 200'000, 1, 4)[0];
  const MarginalComparison comparison =
      compare(plain, std::vector(2, Estimate{{sampled.occupied.begin(), sampled.occupied.end()},
                                             {sampled.upper.begin(), sampled.upper.end()},
                                             sampled.informed}));
  EXPECT_TRUE(comparison.agrees()) << name(kind) << ", sigma " << sigma << ": " << comparison.text();
}

TEST(PosteriorSampler, algorithm1IsThePlainAlgorithm1) {
  const Problem problem = random_problems::make({"oblong", {4, 3, 1}, 2, 8, 0.8}, 23);
  for (const ForwardModel kind : {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam})
    expect_plain_algorithm1(problem, kind, config_for(problem, kind).model.sigma);
  // Where nothing is left of a voxel's weight, it is occupied in four of ten draws all the same.
  expect_plain_algorithm1(problem, ForwardModel::paper, 1e-4);
}

TEST(PosteriorSampler, aVoxelThatNoRayReachesReadsAHalf) {
  Problem problem = random_problems::make({"box", {4, 4, 3}, 1, 1, 0.5}, 1);
  problem.measurements.origins = {problem.grid.lower() + Vector3(-0.2, 0.05, 0.05)};  // along the lowest row
  problem.measurements.rays.clear();
  for (int i = 0; i < 5; ++i)
    problem.measurements.rays.push_back({(problem.measurements.origins[0] + Vector3(0.35, 0, 0)).cast<float>()});
  for (const ForwardModel kind : every_model)
    for (const double prior : {0.05, 0.5, 0.9}) {
      PosteriorSamplerConfig config = config_for(problem, kind);
      config.prior = prior;
      config.sweeps = 300;
      const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config);
      for (std::size_t voxel = 4; voxel < problem.grid.voxel_count(); ++voxel) {
        EXPECT_EQ(posterior.occupied[voxel], 0.5f) << name(kind) << ", voxel " << voxel;
        EXPECT_EQ(posterior.upper[voxel], 0.5f);
        EXPECT_EQ(posterior.informed[voxel], 0);
      }
      EXPECT_EQ(posterior.informed[0], 1);
      EXPECT_EQ(posterior.diagnostics.informed_voxels,
                static_cast<std::size_t>(std::count(posterior.informed.begin(), posterior.informed.end(), 1)));
      const std::vector<Voxel> voxels = posterior.voxels({});
      for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel) {
        EXPECT_EQ(voxels[voxel].probability, posterior.touch[voxel]);
        EXPECT_EQ(voxels[voxel].measured, posterior.informed[voxel] == 1);
      }
    }
}

}  // namespace
}  // namespace nextview

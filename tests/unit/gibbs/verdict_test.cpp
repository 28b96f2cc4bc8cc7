// What a run says of itself, worked out again from the traces that it keeps.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "core/gibbs/posterior_sampler.hpp"
#include "tests/unit/gibbs/plain_diagnostics.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using random_problems::Problem;

constexpr double r_hat_limit = 1.05, trend_limit = 2.576, disagreeing_limit = 1e-4;

GibbsPosterior short_run(const Problem& problem, std::uint64_t seed, StartMap start) {
  PosteriorSamplerConfig config;
  config.model.kind = ForwardModel::beam;
  config.model.sigma = problem.sigma;
  config.prior = 0.3;
  config.seed = seed;
  config.start = start;
  config.sweeps = 45, config.burn_in = 5;
  config.until_stationary = false;
  config.ray_spacing = 0.0;
  return sample_posterior(problem.grid, problem.measurements, config);
}

bool has_enough_samples(const SamplerDiagnostics& d) {
  const double values = 2.0 * (d.sweeps - d.burn_in);
  return d.effective_samples >= std::min(10.0, values / 4.0);
}

/// The z of largest magnitude, with its sign: below 0 if that chain's log-posterior rises, above if it falls.
double strongest_trend(const SamplerDiagnostics& d) {
  double strongest = 0.0;
  for (const plain::Series& chain : plain::of_the_mean(d)) {
    const double z = geweke_z(chain);
    if (std::abs(z) > std::abs(strongest)) strongest = z;
  }
  return strongest;
}

// Over runs of all sorts, among them some that each limit alone decides, on either side.
TEST(Verdict, FollowsFromTheKeptTraces) {
  const Problem problem = random_problems::make({"room", {6, 5, 4}, 3, 100, 0.4}, 7);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);  // runs too short to share
  int stationary = 0, by_r_hat = 0, by_rise = 0, by_fall = 0, rising = 0, falling = 0;
  for (const StartMap start : {StartMap::free, StartMap::occupied})
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
      const SamplerDiagnostics d = short_run(problem, seed, start).diagnostics;
      ASSERT_EQ(d.sweeps, 45);
      ASSERT_EQ(d.burn_in, 5);
      const double r_hat = plain::split_r_hat(plain::of_the_mean(d)), z = strongest_trend(d);
      EXPECT_NEAR(d.r_hat, r_hat, 1e-9);
      EXPECT_EQ(d.trend, std::abs(z)) << "the largest of all chains, whichever way it goes";
      const bool mixed = r_hat < r_hat_limit && has_enough_samples(d), level = std::abs(z) < trend_limit;
      const bool agreed = double(d.disagreeing_voxels) <= disagreeing_limit * double(d.informed_voxels);
      EXPECT_EQ(d.stationary, mixed && level && agreed)
          << fmt::format("R-hat {}, z {}, {} voxels differ", r_hat, z, d.disagreeing_voxels);
      EXPECT_EQ(d.warning.empty(), d.stationary) << d.warning;
      stationary += d.stationary;
      by_r_hat += agreed && level && !mixed && r_hat < 1.3;
      by_rise += agreed && mixed && z < -trend_limit;
      by_fall += agreed && mixed && z > trend_limit;
      (z < 0.0 ? rising : falling) += 1;
    }
  fmt::print("             {} stationary, {} by R-hat, {} by a rise, {} by a fall; {} rise, {} fall\n", stationary,
             by_r_hat, by_rise, by_fall, rising, falling);
  for (const int count : {stationary, by_r_hat, by_rise, by_fall}) EXPECT_GE(count, 2);
  for (const int count : {rising, falling}) EXPECT_GT(count, 20);
}

/// A grid that rays pass from one side to the other, and corridors in which a range ends just between two voxels:
/// whichever of them is occupied hides the other, so a chain stays with the one that it has.
struct Ambiguous {
  static constexpr int edge = 28, pairs = 2;
  VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.28, 0.01);
  RangeMeasurements measurements{1.5, {}, {}};
  std::vector<std::uint32_t> nearer, farther;  ///< one per pair

  Ambiguous() {
    for (int z = 0; z < edge; ++z)
      for (int y = 0; y < edge; ++y) {
        const Vector3 middle = grid.centre(grid.index({edge / 2, y, z}));
        const auto line = std::uint32_t(measurements.origins.size());
        measurements.origins.emplace_back(-0.5, middle.y(), middle.z());
        const bool pair = y == 14 && (z == 10 || z == 20);
        const double end = pair ? middle.x() - 0.005 : 0.9;
        measurements.rays.push_back(
            {Eigen::Vector3f(float(end), float(middle.y()), float(middle.z())), line, pair ? 40u : 4u, !pair});
        if (!pair) continue;
        nearer.push_back(grid.index({edge / 2 - 1, y, z}));
        farther.push_back(grid.index({edge / 2, y, z}));
      }
  }

  /// In the first `disagreeing` pairs the chains start with different voxels.
  SamplerDiagnostics run(int disagreeing, std::uint64_t seed) const {
    PosteriorSamplerConfig config;
    config.model.kind = ForwardModel::beam;
    config.model.sigma = 0.004;
    config.prior = 1e-4;
    config.swaps = 0;
    config.sweeps = 60, config.burn_in = 0;
    config.until_stationary = false;
    config.ray_spacing = 0.0;
    config.seed = seed;
    std::vector<std::vector<std::uint8_t>> warm(2, std::vector<std::uint8_t>(grid.voxel_count(), 0));
    for (int p = 0; p < pairs; ++p) {
      warm[0][nearer[p]] = 1;
      warm[1][(p < disagreeing ? farther : nearer)[p]] = 1;
    }
    return sample_posterior(grid, measurements, config, {}, {warm}).diagnostics;
  }
};

// Of 22,000 voxels 2 may differ between chains, 4 may not: one in ten thousand.
TEST(Verdict, AVoxelInTenThousandMayDifferBetweenChains) {
  const Ambiguous problem;
  for (int disagreeing = 0; disagreeing <= Ambiguous::pairs; ++disagreeing) {
    int judged = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const SamplerDiagnostics d = problem.run(disagreeing, seed);
      EXPECT_EQ(d.disagreeing_voxels, std::size_t(2 * disagreeing)) << "both voxels of a pair";
      EXPECT_GT(d.informed_voxels, 20'000u - 784u);
      if (!(d.r_hat < r_hat_limit && d.trend < trend_limit && has_enough_samples(d))) continue;  // another limit's word
      ++judged;
      EXPECT_EQ(d.stationary, double(2 * disagreeing) <= disagreeing_limit * double(d.informed_voxels)) << disagreeing;
    }
    EXPECT_GE(judged, 3) << disagreeing;
  }
}

/// D_KL(p || q) of one voxel, by the definition [nats].
double divergence(double p, double q) {
  const auto kept_off = [](double x) { return std::min(std::max(x, 1e-6), 1.0 - 1e-6); };
  p = kept_off(p), q = kept_off(q);
  return p * std::log(p / q) + (1.0 - p) * std::log((1.0 - p) / (1.0 - q));
}

/// The posteriors of 4 to 12 sweeps of one chain. It draws the same however many follow, so these are its running
/// means.
std::vector<GibbsPosterior> running_means(const Problem& problem) {
  PosteriorSamplerConfig config;
  config.model.kind = ForwardModel::beam;
  config.model.sigma = problem.sigma;
  config.prior = 0.3;
  config.chains = 1, config.burn_in = 0;
  config.until_stationary = false, config.keep_traces = true;
  config.ray_spacing = 0.0;
  std::vector<GibbsPosterior> means;
  for (config.sweeps = 4; config.sweeps <= 12; ++config.sweeps)
    means.push_back(sample_posterior(problem.grid, problem.measurements, config));
  return means;
}

/// Whether the posterior has the means of all voxels near a return: it tells them of informed ones only.
bool tells_all(const GibbsPosterior& posterior) {
  const auto& near = posterior.traces.voxels;
  return std::all_of(near.begin(), near.end(), [&](std::uint32_t v) { return posterior.informed[v] != 0; });
}

TEST(Verdict, TheDivergenceIsOfTheMeanNowFromTheMeanBefore) {
  double gap = 0.0;
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto means = running_means(random_problems::make({"oblong", {4, 3, 1}, 2, 12, 0.8}, seed));
    const std::vector<double>& found = means.back().diagnostics.divergence;
    ASSERT_EQ(found.size(), 11u) << "from the second sweep on";
    for (std::size_t m = 1; m < means.size(); ++m) {
      if (!tells_all(means[m]) || !tells_all(means[m - 1])) continue;
      double expected = 0.0, backwards = 0.0;
      for (const std::uint32_t v : means[m].traces.voxels) {
        expected += divergence(means[m].occupied[v], means[m - 1].occupied[v]);
        backwards += divergence(means[m - 1].occupied[v], means[m].occupied[v]);
      }
      EXPECT_NEAR(found.at(m + 2), expected, 1e-5 + 1e-3 * expected) << "means[0] is of 4 sweeps, found[0] of the 2nd";
      gap = std::max(gap, std::abs(expected - backwards) / (1e-3 + expected + backwards));
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
  EXPECT_GT(gap, 0.02) << "with these test problems either direction would do";
}

}  // namespace
}  // namespace nextview

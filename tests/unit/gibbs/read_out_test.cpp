#include "core/gibbs/read_out.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <optional>

#include "core/gibbs/posterior_sampler.hpp"
#include "core/gibbs/sites.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using random_problems::Problem;

Problem room_of_weighted_rays() { return random_problems::make({"room", {8, 7, 5}, 4, 400, 0.4, true}, 7); }

PosteriorSamplerConfig sixty_sweeps(const Problem& problem) {
  PosteriorSamplerConfig config;
  config.model.sigma = problem.sigma;
  config.sweeps = 60, config.burn_in = 5;
  config.until_stationary = false;
  config.ray_spacing = 0.0;
  return config;
}

/// From the definition: walks each ray's line in small steps.
std::vector<RayCount> plain_counts(const Problem& problem) {
  std::vector<RayCount> counts(problem.grid.voxel_count());
  const RangeMeasurements& measurements = problem.measurements;
  for (const RangeMeasurement& ray : measurements.rays) {
    const double z = measurements.range(ray);
    std::vector<std::uint8_t> passed(counts.size());
    std::optional<std::uint32_t> last;
    const double step = 1e-4;
    for (double t = 0.5 * step; t < z; t += step) {
      const Vector3 point = measurements.origins[ray.origin] + t * measurements.direction(ray);
      const Eigen::Vector3i cell = problem.grid.cell_at(point);
      last.reset();
      if (!problem.grid.contains(cell)) continue;
      last = problem.grid.index(cell);
      passed[*last] = 1;
    }
    if (!ray.beyond_range && last) passed[*last] = 0, counts[*last].ended += float(ray.weight);
    for (std::size_t v = 0; v < counts.size(); ++v) counts[v].passed += float(passed[v] * ray.weight);
  }
  return counts;
}

TEST(ReadOut, CountsRaysUpToWhereTheyEnd) {
  const Problem problem = room_of_weighted_rays();
  for (const ForwardModel kind : {ForwardModel::attenuation, ForwardModel::paper}) {
    ForwardSensorModel model;
    model.kind = kind;
    model.sigma = problem.sigma;
    const auto counts = read_out_rays(RayLists(problem.grid, problem.measurements, model)).counts;
    const auto expected = plain_counts(problem);
    double passed = 0.0, ended = 0.0, difference = 0.0;
    for (std::size_t v = 0; v < counts.size(); ++v) {
      passed += expected[v].passed, ended += expected[v].ended;
      difference += std::abs(counts[v].passed - expected[v].passed) + std::abs(counts[v].ended - expected[v].ended);
    }
    EXPECT_GT(passed, 1000.0);
    EXPECT_GT(ended, 100.0);
    EXPECT_LT(difference, 0.005 * (passed + ended)) << "corners that small steps miss, and no more";
  }
}

// Two rays along a row of voxels of 0.1 m, one of them for three: the second ends 0.02 m behind the first.
TEST(ReadOut, MeasuresHowFarRaysEndBehindACentre) {
  const VoxelGrid grid{0.1, {0, 0, 0}, {10, 1, 1}};
  RangeMeasurements measurements{3.0, {{-0.5, 0.05, 0.05}}, {}};
  measurements.rays.push_back({{0.54f, 0.05f, 0.05f}, 0, 1, false});
  measurements.rays.push_back({{0.56f, 0.05f, 0.05f}, 0, 3, false});
  measurements.rays.push_back({{2.5f, 0.05f, 0.05f}, 0, 5, true});
  ForwardSensorModel model;
  model.sigma = 0.05;
  const auto counts = read_out_rays(RayLists(grid, measurements, model)).counts;
  const double end = (0.54 + 3 * 0.56) / 4;
  for (const int v : {4, 5, 6}) {
    EXPECT_EQ(counts[v].near, 4.0f) << v;
    EXPECT_NEAR(counts[v].behind, (end - (0.05 + 0.1 * v)) / 0.1, 1e-4) << v;
  }
  EXPECT_EQ(counts[5].ended, 4.0f);
  for (const int v : {3, 7, 9}) {
    EXPECT_EQ(counts[v].near, 0.0f) << "too far from where they end; and beyond range ends nowhere: " << v;
    EXPECT_EQ(counts[v].behind, 0.0f) << v;
  }
}

// Voxels, ranges and places are sums of powers of two: the ray ends on the face to the last bit.
TEST(ReadOut, ARayThatEndsOnAFaceEndsInTheVoxelThatItWouldGoOnInto) {
  const VoxelGrid grid{0.125, {0, 0, 0}, {8, 1, 1}};
  for (const bool upwards : {true, false})
    for (const ForwardModel kind : {ForwardModel::attenuation, ForwardModel::paper}) {
      RangeMeasurements measurements{3.0, {{upwards ? -0.5 : 1.5, 0.0625, 0.0625}}, {}};
      measurements.rays.push_back({{0.5f, 0.0625f, 0.0625f}, 0, 1, false});
      ForwardSensorModel model;
      model.kind = kind;
      model.sigma = 0.05;
      const auto counts = read_out_rays(RayLists(grid, measurements, model)).counts;
      for (int v = 0; v < 8; ++v) {
        EXPECT_EQ(counts[v].ended, v == (upwards ? 4 : 3) ? 1.0f : 0.0f) << v << upwards;
        EXPECT_EQ(counts[v].passed, (upwards ? v < 4 : v > 3) ? 1.0f : 0.0f) << v << upwards;
      }
    }
}

/// A posterior written by hand over 3 x 3 x 3 voxels.
struct ByHand {
  GibbsPosterior posterior;
  ReadOutRays rays;  ///< without a place that they end at, if they do

  ByHand() {
    posterior.grid = {0.1, {0, 0, 0}, {3, 3, 3}};
    rays.ends = RayEnds(RayLists(posterior.grid, {}, {}));
    posterior.occupied.assign(27, 0.1f);
    posterior.upper.assign(27, 0.05f);
    posterior.informed.assign(27, 1);
    rays.counts.assign(27, {9.0f, 0.0f});
  }
};

TEST(ReadOut, LooksAtAVoxelAndThoseAroundIt) {
  ByHand by_hand;
  by_hand.posterior.occupied[13] = 0.8f;
  by_hand.posterior.upper[13] = 0.6f;
  by_hand.rays.counts[13] = {3.0f, 7.0f, 9.0f, -0.8f};
  by_hand.posterior.informed[12] = 0;                                   // beside it
  by_hand.posterior.occupied[12] = by_hand.posterior.upper[12] = 0.5f;  // as what is not informed reads
  by_hand.posterior.informed[0] = 0, by_hand.rays.counts[0] = {};       // at a corner
  const auto x = ReadOutFeatures(by_hand.posterior, by_hand.rays).of(13);
  const auto near = [&](int k, double expected) { EXPECT_NEAR(x[k], expected, 1e-5) << "feature " << k; };
  near(0, 1.0), near(1, std::log(4.0)), near(2, std::log(1.5));
  near(3, 1.0), near(4, 2.0);
  near(5, 5 * 0.1), near(6, 24 * 0.1), near(7, 5 * 0.05), near(8, 24 * 0.05);
  near(9, 5 * std::log(1.0 / 9.0));
  near(10, std::log(11.0)), near(11, std::log(7.05 / 3.05));
  near(12, 0.0), near(13, 1.0), near(14, 0.0), near(15, 0.0);
  near(16, 25 * std::log(10.0));
  near(17, std::log(8.0)), near(18, 0.0), near(19, 0.0);
  near(20, 1.0), near(21, -0.8), near(22, -0.8 * std::log(10.0));
  near(23, 6.0), near(24, 25.0), near(25, 0.0), near(26, 0.0);
}

TEST(ReadOut, KnowsFacesFromEdgesAndCorners) {
  for (const int beside : {4, 1, 0}) {  // through a face, an edge, a corner
    ByHand by_hand;
    by_hand.rays.counts[beside] = {1.0f, 3.0f, 2.0f, 0.3f};
    const auto x = ReadOutFeatures(by_hand.posterior, by_hand.rays).of(13);
    const bool face = beside == 4;
    const auto near = [&](int k, double expected) { EXPECT_NEAR(x[k], expected, 1e-5) << "feature " << k; };
    near(14, face ? 3.0 / 4.1 : 0.0), near(15, 3.0 / 4.1);
    near(18, std::log(4.0)), near(19, face ? std::log(4.0) : 0.0);
    near(23, face ? 5.0 : 6.0), near(24, 25.0);
    near(25, face ? 0.3 / 1.5 : 0.0), near(26, 0.3 / 1.5);
  }
}

/// A room with its posterior, and its rays as the read-out sees them.
struct RefinedRoom {
  Problem problem = room_of_weighted_rays();
  GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, sixty_sweeps(problem));
  ReadOutRays rays = read_out_rays(RayLists(problem.grid, problem.measurements, sixty_sweeps(problem).model));
};

TEST(ReadOut, SomeLayersHaveTheFeaturesThatTheyHaveAmongAll) {
  const RefinedRoom room;
  const ReadOutFeatures all(room.posterior, room.rays);
  const int layers = room.problem.grid.size.z();
  for (int z = 0; z < layers; ++z) {
    const ReadOutFeatures some(room.posterior, room.rays, {z, z + 1});
    for (std::uint32_t v = room.problem.grid.index({0, 0, z}); v < room.problem.grid.index({0, 0, z + 1}); ++v)
      EXPECT_EQ(some.of(v), all.of(v)) << v;
  }
}

TEST(ReadOut, LooksAtThePlanesThroughWhereRaysEnd) {
  const RefinedRoom room;
  const ReadOutFeatures features(room.posterior, room.rays);
  int planes = 0;
  for (std::uint32_t v = 0; v < room.problem.grid.voxel_count(); ++v) {
    const SurfacePatch near = room.rays.ends.patch(v), wide = room.rays.ends.wide_patch(v);
    const auto x = features.of(v);
    EXPECT_EQ(x[28], near.distance);
    EXPECT_EQ(x[30], near.half - std::abs(near.distance));
    EXPECT_EQ(x[34], near.from_behind);
    EXPECT_EQ(x[36], wide.distance);
    EXPECT_EQ(x[39], wide.roughness);
    planes += near.ends > 0.0f;
  }
  EXPECT_GT(planes, 50);
}

TEST(ReadOut, VoxelsBeyondTheGridArePassedAndNeitherUnknownNorHidden) {
  const ByHand by_hand;
  const ReadOutFeatures features(by_hand.posterior, by_hand.rays);
  for (const std::uint32_t v : {0u, 13u, 26u}) {
    const auto x = features.of(v);
    for (const int none : {3, 4, 12, 13}) EXPECT_EQ(x[none], 0.0f) << v;
    EXPECT_EQ(x[23], 6.0f) << v;
    EXPECT_EQ(x[24], 26.0f) << v;
  }
  EXPECT_LT(features.of(0)[6], features.of(13)[6]);
}

TEST(ReadOut, IsTheLogisticOfWhatTheNetworkSays) {
  ByHand by_hand;
  by_hand.posterior.informed[5] = 0;
  for (RayCount& rays : by_hand.rays.counts) rays = {8.0f, 1.0f, 1.0f, 0.0f};
  ReadOutWeights weights{};
  weights.touch.linear[0] = -0.4f, weights.touch.linear[1] = 0.5f;
  weights.centre.linear[10] = -1.0f;
  weights.centre.in[0][2] = -3.0f, weights.centre.in[10][2] = 1.0f, weights.centre.out[2] = 2.0f;
  weights.centre.in[10][15] = 0.5f, weights.centre.out[15] = -1.0f;
  read_out(by_hand.posterior, by_hand.rays, weights);
  EXPECT_NEAR(by_hand.posterior.touch[13], 1.0 / (1.0 + std::exp(0.4 + 0.5 * std::log(9.0))), 1e-6);
  const double crossed = std::log(10.0), bent = (crossed - 3.0) / (1.0 + (3.0 - crossed));
  const double log_odds = -crossed + 2.0 * bent - 0.5 * crossed / (1.0 + 0.5 * crossed);
  EXPECT_NEAR(by_hand.posterior.centre[13], 1.0 / (1.0 + std::exp(-log_odds)), 1e-6);
  EXPECT_EQ(by_hand.posterior.touch[5], 0.5f) << "not informed";
  EXPECT_EQ(by_hand.posterior.centre[5], 0.5f);
}

// As at the end of a short camera's range: what nobody looked at lies around, and nothing was met.
TEST(ReadOut, WhereRaysOnlyPassedItSaysNoMoreThanTheLevels) {
  ByHand by_hand;
  ReadOutWeights sure{};
  sure.touch.linear[0] = sure.centre.linear[0] = 4.0f;
  read_out(by_hand.posterior, by_hand.rays, sure);
  EXPECT_EQ(by_hand.posterior.touch[13], 0.1f);
  EXPECT_EQ(by_hand.posterior.centre[13], 0.1f);
  by_hand.rays.counts[12].ended = 1.0f;
  read_out(by_hand.posterior, by_hand.rays, sure);
  EXPECT_GT(by_hand.posterior.touch[13], 0.9f) << "a ray ended beside it";
  EXPECT_EQ(by_hand.posterior.touch[14], 0.1f) << "two voxels from where it ended";
}

TEST(ReadOut, OfThePosteriorIsThatOfItsRaysAndLevels) {
  const Problem problem = room_of_weighted_rays();
  const PosteriorSamplerConfig config = sixty_sweeps(problem);
  GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config);
  const auto touch = posterior.touch, centre = posterior.centre;
  EXPECT_NE(touch, posterior.occupied);
  EXPECT_NE(touch, centre);
  read_out(posterior, read_out_rays(RayLists(problem.grid, problem.measurements, config.model)), fitted_read_out());
  EXPECT_EQ(posterior.touch, touch);
  EXPECT_EQ(posterior.centre, centre);
  const auto voxels = posterior.voxels({}), centres = posterior.centre_voxels({});
  for (std::size_t v = 0; v < touch.size(); ++v) {
    EXPECT_EQ(voxels[v].probability, touch[v]);
    EXPECT_EQ(centres[v].probability, centre[v]);
    EXPECT_EQ(centres[v].measured, posterior.informed[v] != 0);
  }
}

TEST(ReadOut, OfSomeSitesIsThatOfAllAroundThem) {
  const Problem problem = random_problems::make({"large room", {14, 13, 12}, 3, 30, 0.1}, 7);
  const PosteriorSamplerConfig config = sixty_sweeps(problem);
  const GibbsPosterior all = sample_posterior(problem.grid, problem.measurements, config);
  const RayLists lists(problem.grid, problem.measurements, config.model);
  Sites sites = find_sites(lists, config, {});
  for (const std::size_t v : {std::size_t(200), std::size_t(900)}) sites.kind[v] = Sites::front;
  sites.near_voxels.resize(3), sites.front_voxels = {200, 900};
  GibbsPosterior some = all;
  std::ranges::fill(some.touch, 2.0f);
  std::ranges::fill(some.centre, 2.0f);
  const BitRows wanted = voxels_read_out(problem.grid, sites);
  read_out(some, read_out_rays(lists, with_neighbours(wanted)), fitted_read_out(), &wanted);
  std::size_t asked = 0;
  for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
    const auto steps_from = [&](std::uint32_t site) {
      return (problem.grid.cell(v) - problem.grid.cell(site)).cwiseAbs().maxCoeff();
    };
    const bool is_asked = v == 200 || v == 900 ||
                          std::ranges::any_of(sites.near_voxels, [&](std::uint32_t n) { return steps_from(n) <= 2; });
    asked += is_asked;
    EXPECT_EQ(some.touch[v], is_asked ? all.touch[v] : 2.0f) << v;
    EXPECT_EQ(some.centre[v], is_asked ? all.centre[v] : 2.0f) << v;
  }
  EXPECT_LT(asked, problem.grid.voxel_count() / 2);
}

TEST(ReadOut, IsTheSameBytesOnAnyNumberOfThreads) {
  const Problem problem = room_of_weighted_rays();
  PosteriorSamplerConfig config = sixty_sweeps(problem);
  config.model.independence = 0.0;
  std::vector<GibbsPosterior> posteriors;
  for (const std::size_t threads : {1, 2, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    posteriors.push_back(sample_posterior(problem.grid, problem.measurements, config));
    EXPECT_EQ(posteriors.back().touch, posteriors.front().touch);
    EXPECT_EQ(posteriors.back().centre, posteriors.front().centre);
  }
}

TEST(ReadOut, IsNotAppliedToLevelsThatItWasNotFittedTo) {
  const Problem problem = room_of_weighted_rays();
  std::vector<PosteriorSamplerConfig> configs(6, sixty_sweeps(problem));
  configs[0].read_out = ReadOut::levels;
  configs[1].model.kind = ForwardModel::beam;
  configs[2].sampler = Sampler::algorithm1;
  configs[3].updated = UpdatedVoxels::occupied;
  configs[4].model.attenuations = {0.3, 2.0};
  configs[5].prior = 0.3;
  const std::vector<float> start(problem.grid.voxel_count(), 0.7f);
  for (const PosteriorSamplerConfig& config : configs) {
    const GibbsPosterior posterior = sample_posterior(problem.grid, problem.measurements, config, start);
    EXPECT_EQ(posterior.touch, posterior.occupied);
    EXPECT_EQ(posterior.centre, posterior.occupied);
  }
}

}  // namespace
}  // namespace nextview

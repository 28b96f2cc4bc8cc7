// The sampler at the edges of what it may be given: an error that says why, or numbers; never NaN, never a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/gibbs/posterior_sampler.hpp"
#include "tests/unit/gibbs/tested_values.hpp"

namespace nextview {
namespace {

const VoxelGrid corridor{0.1, {0, 0, 0}, {8, 1, 1}};

PosteriorSamplerConfig quick(ForwardModel kind) {
  PosteriorSamplerConfig config;
  config.model.kind = kind;
  config.model.sigma = 0.03;
  config.model.attenuations = {0.3, 2.0};
  config.sweeps = 60;
  return config;
}

RangeMeasurements rays(std::initializer_list<float> hits, int misses = 0) {
  RangeMeasurements measurements;
  measurements.origins = {{-0.1, 0.05, 0.05}};
  for (const float x : hits) measurements.rays.push_back({{x, 0.05f, 0.05f}});
  for (int i = 0; i < misses; ++i) measurements.rays.push_back({{1.4f, 0.05f, 0.05f}, 0, 1, true});
  return measurements;
}

void expect_numbers(const GibbsPosterior& posterior) {
  for (const auto* values : {&posterior.occupied, &posterior.upper})
    for (const float p : *values) {
      ASSERT_GE(p, 0.0f);
      ASSERT_LE(p, 1.0f);
    }
  const SamplerDiagnostics& d = posterior.diagnostics;
  for (const double value : {d.effective_samples, d.trend, d.voxel_effective_samples, d.r_hat, d.voxel_r_hat})
    EXPECT_FALSE(std::isnan(value));
  for (const auto& chain : d.log_posterior)
    for (const double value : chain) ASSERT_TRUE(std::isfinite(value));
  for (const double value : d.divergence) ASSERT_TRUE(std::isfinite(value));
}

/// An error with a reason, or numbers.
void expect_error_or_numbers(const VoxelGrid& grid, const RangeMeasurements& measurements,
                             const PosteriorSamplerConfig& config) {
  try {
    expect_numbers(sample_posterior(grid, measurements, config));
  } catch (const std::invalid_argument& error) {
    EXPECT_FALSE(std::string(error.what()).empty());
  }
}

TEST(PosteriorSamplerEdges, noRaysAtAll) {
  for (const ForwardModel kind : every_model) {
    const GibbsPosterior posterior = sample_posterior(corridor, {}, quick(kind));
    expect_numbers(posterior);
    EXPECT_EQ(posterior.occupied, std::vector<float>(8, 0.5f));
    EXPECT_EQ(posterior.informed, std::vector<std::uint8_t>(8, 0));
  }
}

TEST(PosteriorSamplerEdges, raysThatMissTheGrid) {
  RangeMeasurements measurements;
  measurements.origins = {{0, 5, 5}};
  measurements.rays = {{{1.0f, 5.0f, 5.0f}}, {{0.0f, 6.5f, 5.0f}, 0, 1, true}};
  for (const ForwardModel kind : every_model)
    EXPECT_EQ(sample_posterior(corridor, measurements, quick(kind)).occupied, std::vector<float>(8, 0.5f));
}

TEST(PosteriorSamplerEdges, oneRay) {
  for (const ForwardModel kind : every_model) {
    expect_numbers(sample_posterior(corridor, rays({0.35f}), quick(kind)));
    expect_numbers(sample_posterior(corridor, rays({}, 1), quick(kind)));
  }
}

TEST(PosteriorSamplerEdges, allNoReturnsEmptyTheCorridor) {
  for (const ForwardModel kind : {ForwardModel::paper, ForwardModel::beam, ForwardModel::attenuation}) {
    const GibbsPosterior posterior = sample_posterior(corridor, rays({}, 40), quick(kind));
    expect_numbers(posterior);
    for (const float p : posterior.occupied) EXPECT_LT(p, 0.05f) << name(kind);
  }
  expect_numbers(sample_posterior(corridor, rays({}, 40), quick(ForwardModel::cone)));
}

TEST(PosteriorSamplerEdges, raysThatContradictEachOther) {
  RangeMeasurements measurements;
  for (int i = 0; i < 200; ++i) {
    const RangeMeasurements more = rays({0.35f}, 1);
    measurements.origins = more.origins;
    measurements.rays.insert(measurements.rays.end(), more.rays.begin(), more.rays.end());
  }
  for (const ForwardModel kind : every_model)
    for (const double sigma : {0.03, 1e-4}) {
      PosteriorSamplerConfig config = quick(kind);
      config.model.sigma = sigma;
      expect_numbers(sample_posterior(corridor, measurements, config));
      for (RangeMeasurement& ray : measurements.rays) ray.weight = 65'535;
      expect_numbers(sample_posterior(corridor, measurements, config));
    }
}

TEST(PosteriorSamplerEdges, aCameraInsideTheGrid) {
  RangeMeasurements measurements = rays({0.75f, 0.05f}, 2);
  measurements.origins = {{0.34, 0.05, 0.05}};
  for (const ForwardModel kind : every_model) expect_numbers(sample_posterior(corridor, measurements, quick(kind)));
}

TEST(PosteriorSamplerEdges, raysThatAreNotNumbers) {
  const std::function<void(RangeMeasurements&)> wrong[] = {
      [](auto& m) { m.rays[0].end.x() = static_cast<float>(nan); },
      [](auto& m) { m.rays[0].end.z() = static_cast<float>(infinity); },
      [](auto& m) { m.origins[0].y() = nan; },
      [](auto& m) { m.rays[0].end = m.origins[0].template cast<float>(); },
      [](auto& m) { m.rays[0].weight = 0; },
      [](auto& m) { m.max_range = nan; },
      [](auto& m) { m.max_range = 0.0; },
      [](auto& m) { m.max_range = infinity; }};
  for (const ForwardModel kind : every_model)
    for (const auto& change : wrong)
      for (const double spacing : {0.0, 0.6}) {
        SCOPED_TRACE(std::string(name(kind)) + ", change " + std::to_string(&change - wrong));
        RangeMeasurements measurements = rays({0.35f, 0.45f}, 1);
        change(measurements);
        PosteriorSamplerConfig config = quick(kind);
        config.ray_spacing = spacing;
        expect_error_or_numbers(corridor, measurements, config);
      }
}

TEST(PosteriorSamplerEdges, aRayOfAnOriginThatIsNotThereIsRefused) {
  RangeMeasurements measurements = rays({0.35f});
  measurements.rays[0].origin = 77;
  EXPECT_THROW(sample_posterior(corridor, measurements, quick(ForwardModel::beam)), std::invalid_argument);
}

TEST(PosteriorSamplerEdges, aCameraAtInfinityIsNotWalkedFrom) {
  for (const double x : {-infinity, infinity}) {
    RangeMeasurements measurements = rays({0.35f}, 1);
    measurements.origins[0].x() = x;
    expect_error_or_numbers(corridor, measurements, quick(ForwardModel::beam));
  }
}

TEST(PosteriorSamplerEdges, configurationsOutOfBoundsNameTheField) {
  struct Wrong {
    const char* field;
    std::function<void(PosteriorSamplerConfig&)> change;
  };
  const Wrong wrong[] = {{"prior", [](auto& c) { c.prior = nan; }},
                         {"prior", [](auto& c) { c.prior = 0.0; }},
                         {"prior", [](auto& c) { c.prior = 1.0; }},
                         {"sigma", [](auto& c) { c.model.sigma = nan; }},
                         {"sigma", [](auto& c) { c.model.sigma = 0.0; }},
                         {"swaps", [](auto& c) { c.swaps = -2; }},
                         {"plaquettes", [](auto& c) { c.plaquettes = -1; }},
                         {"chains", [](auto& c) { c.chains = 0; }},
                         {"sweeps", [](auto& c) { c.sweeps = 0; }},
                         {"burn_in", [](auto& c) { c.burn_in = -1; }},
                         {"ray_spacing", [](auto& c) { c.ray_spacing = -0.1; }},
                         {"ray_spacing", [](auto& c) { c.ray_spacing = nan; }}};
  for (const auto& [field, change] : wrong) {
    PosteriorSamplerConfig config = quick(ForwardModel::attenuation);
    change(config);
    try {
      sample_posterior(corridor, rays({0.35f}), config);
      ADD_FAILURE() << field << " out of bounds was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(field));
    }
  }
}

TEST(PosteriorSamplerEdges, startsThatDoNotFitAreRefused) {
  const PosteriorSamplerConfig config = quick(ForwardModel::beam);
  const RangeMeasurements measurements = rays({0.35f});
  const std::vector<float> short_map(3, 0.5f);
  EXPECT_THROW(sample_posterior(corridor, measurements, config, short_map), std::invalid_argument);
  const std::vector<std::vector<std::uint8_t>> short_states(2, std::vector<std::uint8_t>(3, 0));
  EXPECT_THROW(sample_posterior(corridor, measurements, config, {}, {short_states}), std::invalid_argument);
}

TEST(PosteriorSamplerEdges, aPosteriorThatCannotBeKeptIsRefused) {
  PosteriorSamplerConfig config = quick(ForwardModel::beam);
  const RangeMeasurements measurements = rays({0.35f});
  const GibbsPosterior earlier = sample_posterior(corridor, measurements, config);
  EXPECT_NO_THROW(sample_posterior(corridor, measurements, config, {}, {earlier.states, &earlier}));
  const GibbsPosterior none;
  EXPECT_THROW(sample_posterior(corridor, measurements, config, {}, {earlier.states, &none}), std::invalid_argument);
  EXPECT_THROW(sample_posterior(corridor, measurements, config, {}, {{}, &earlier}), std::invalid_argument);
  config.updated = UpdatedVoxels::occupied;
  EXPECT_THROW(sample_posterior(corridor, measurements, config, {}, {earlier.states, &earlier}), std::invalid_argument);
}

TEST(PosteriorSamplerEdges, aWarmStartWithLevelsThatTheModelLacksIsRefused) {
  const PosteriorSamplerConfig config = quick(ForwardModel::beam);
  const std::vector<std::vector<std::uint8_t>> unknown_level(2, std::vector<std::uint8_t>(8, 9));
  EXPECT_THROW(sample_posterior(corridor, rays({0.35f}), config, {}, {unknown_level}), std::invalid_argument);
}

TEST(PosteriorSamplerEdges, aMapThatIsNotANumberIsNoStart) {
  PosteriorSamplerConfig config = quick(ForwardModel::attenuation);
  config.start = StartMap::octree;
  const std::vector<float> map(8, static_cast<float>(nan));
  try {
    expect_numbers(sample_posterior(corridor, rays({0.35f}), config, map));
  } catch (const std::invalid_argument&) {
  }
}

TEST(PosteriorSamplerEdges, aRequestedStopEndsEarlyAndWarns) {
  PosteriorSamplerConfig config = quick(ForwardModel::attenuation);
  config.sweeps = 200'000;
  config.until_stationary = false;
  std::stop_source source;
  double last = 0.0;
  const auto stop_soon = [&](double fraction, std::string_view what, const SamplerDiagnostics&) {
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
    EXPECT_FALSE(what.empty());
    last = std::max(last, fraction);
    if (fraction > 0.02) source.request_stop();
  };
  const GibbsPosterior posterior =
      sample_posterior(corridor, rays({0.35f, 0.45f}, 1), config, {}, {}, stop_soon, source.get_token());
  expect_numbers(posterior);
  EXPECT_TRUE(source.stop_requested()) << "progress was never reported past " << last;
  EXPECT_LT(posterior.diagnostics.sweeps, 150'000);
  EXPECT_FALSE(posterior.diagnostics.warning.empty());
  EXPECT_FALSE(posterior.diagnostics.stationary) << "what was stopped was not asked in time";
}

TEST(PosteriorSamplerEdges, ProgressIsToWhereItIsAskedWhetherItIsEnoughAndLeavesRoomForMore) {
  PosteriorSamplerConfig config = quick(ForwardModel::attenuation);
  config.sweeps = 100'000;
  config.until_stationary = true;
  bool had_to_go_on = false;
  for (config.seed = 1; config.seed <= 40; ++config.seed) {
    std::vector<double> told;
    const auto watch = [&](double fraction, std::string_view, const SamplerDiagnostics&) { told.push_back(fraction); };
    const GibbsPosterior posterior = sample_posterior(corridor, rays({0.35f, 0.45f}, 1), config, {}, {}, watch);
    EXPECT_TRUE(posterior.diagnostics.stationary);
    EXPECT_LT(posterior.diagnostics.sweeps, 10'000);
    EXPECT_TRUE(std::ranges::is_sorted(told)) << "it never goes back";
    EXPECT_GE(told.back(), 0.9) << "not a share of all the sweeps it might have taken";
    EXPECT_LT(told.back(), 1.0) << "not full before the end";
    had_to_go_on = had_to_go_on || told.back() > 0.9;
  }
  EXPECT_TRUE(had_to_go_on);
}

TEST(PosteriorSamplerEdges, aStopBeforeTheStartGivesNumbersToo) {
  std::stop_source source;
  source.request_stop();
  for (const ForwardModel kind : every_model) {
    const GibbsPosterior posterior =
        sample_posterior(corridor, rays({0.35f}, 1), quick(kind), {}, {}, {}, source.get_token());
    expect_numbers(posterior);
    EXPECT_FALSE(posterior.diagnostics.warning.empty());
  }
}

TEST(PosteriorSamplerEdges, whatCannotFitIntoMemoryIsRefused) {
  PosteriorSamplerConfig config = quick(ForwardModel::paper);
  config.ray_spacing = 0.0;
  for (const Eigen::Vector3i& size : {Eigen::Vector3i(2'000'000, 2'000'000, 2'000'000), {100'000, 100'000, 100}})
    EXPECT_THROW(sample_posterior({0.001, {0, 0, 0}, size}, rays({0.35f}), config), std::invalid_argument);
  // Long rays through fine voxels: more pairs of ray and voxel than 8 GiB hold.
  const VoxelGrid fine{1e-6, {0, 0, 0}, {1'000'000, 1, 1}};
  RangeMeasurements many;
  many.origins = {{-0.1, 5e-7, 5e-7}};
  many.rays.assign(800, {{0.99f, 5e-7f, 5e-7f}});
  EXPECT_THROW(sample_posterior(fine, many, config), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

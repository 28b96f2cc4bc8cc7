#include "core/gibbs/forward_sensor_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/random/counter_random.hpp"
#include "tests/unit/gibbs/plain_model.hpp"
#include "tests/unit/gibbs/random_problems.hpp"
#include "tests/unit/gibbs/tested_values.hpp"

namespace nextview {
namespace {

/// A corridor along x of voxels 0.1 m long, seen from 0.1 m before it: voxel n spans ranges 0.1 (n + 1) to 0.1 (n + 2).
struct Corridor {
  VoxelGrid grid{0.1, {0, 0, 0}, {8, 1, 1}};
  RangeMeasurements measurements;
  Corridor() {
    measurements.max_range = 1.2;
    measurements.origins = {{-0.1, 0.05, 0.05}};
  }
  RangeMeasurement returning(double z) const { return {{static_cast<float>(z - 0.1), 0.05f, 0.05f}}; }
  RangeMeasurement beyond() const {
    RangeMeasurement ray = returning(measurements.max_range);
    ray.beyond_range = true;
    return ray;
  }
  double log_likelihood(const ForwardSensorModel& model, const RangeMeasurement& ray,
                        const std::vector<std::uint8_t>& map) const {
    return nextview::log_likelihood(grid, model, measurements, ray, map);
  }
};
const std::vector<std::uint8_t> all_free(8, 0);

ForwardSensorModel of_kind(ForwardModel kind, double sigma = 0.03) {
  ForwardSensorModel model;
  model.kind = kind;
  model.sigma = sigma;
  return model;
}

TEST(ForwardSensorModel, validateNamesTheField) {
  struct Wrong {
    const char* field;
    std::function<void(ForwardSensorModel&)> change;
  };
  const Wrong wrong[] = {{"sigma", [](auto& m) { m.sigma = 0.0; }},
                         {"sigma", [](auto& m) { m.sigma = -0.1; }},
                         {"sigma", [](auto& m) { m.sigma = nan; }},
                         {"sigma", [](auto& m) { m.sigma = infinity; }},
                         {"angular_sigma", [](auto& m) { m.angular_sigma = 0.0; }},
                         {"angular_sigma", [](auto& m) { m.angular_sigma = nan; }},
                         {"random_weight", [](auto& m) { m.random_weight = 0.0; }},
                         {"random_weight", [](auto& m) { m.random_weight = 1.0; }},
                         {"random_weight", [](auto& m) { m.random_weight = nan; }},
                         {"max_weight", [](auto& m) { m.max_weight = -0.1; }},
                         {"max_weight", [](auto& m) { m.max_weight = nan; }},
                         {"weight", [](auto& m) { m.random_weight = 0.6, m.max_weight = 0.6; }},
                         {"eta_hit", [](auto& m) { m.eta_hit = -1.0; }},
                         {"eta_hit", [](auto& m) { m.eta_hit = nan; }},
                         {"attenuations", [](auto& m) { m.attenuations = {}; }},
                         {"attenuations",
                          [](auto& m) {
                            m.attenuations = {2.0, 0.3};
                          }},
                         {"attenuations",
                          [](auto& m) {
                            m.attenuations = {0.0, 0.3};
                          }},
                         {"attenuations",
                          [](auto& m) {
                            m.attenuations = {0.3, nan};
                          }},
                         {"attenuations", [](auto& m) { m.attenuations = std::vector<double>(300, 1.0); }}};
  for (const auto& [field, change] : wrong) {
    ForwardSensorModel model;
    change(model);
    try {
      model.validate();
      ADD_FAILURE() << field << " out of bounds was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(field));
    }
  }
  for (const ForwardModel kind : every_model) EXPECT_NO_THROW(of_kind(kind).validate());
}

TEST(ForwardSensorModel, transmissionFollowsTheLawOfBeer) {
  ForwardSensorModel model = of_kind(ForwardModel::attenuation);
  model.attenuations = {0.3, 2.0};
  EXPECT_EQ(model.levels(), 3);
  for (const double chord : {0.0, 0.4, 1.0, 1.7}) {
    EXPECT_DOUBLE_EQ(model.transmission(0, chord), 1.0);
    EXPECT_NEAR(model.transmission(1, chord), std::exp(-0.3 * chord), 1e-12);
    EXPECT_NEAR(model.transmission(2, chord), std::exp(-2.0 * chord), 1e-12);
  }
  for (const ForwardModel kind : {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam}) {
    EXPECT_EQ(of_kind(kind).levels(), 2);
    EXPECT_EQ(of_kind(kind).transmission(0, 0.5), 1.0);
    EXPECT_EQ(of_kind(kind).transmission(1, 0.5), 0.0);
  }
}

TEST(RaySegments, areTheVoxelsOfASlabTest) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const random_problems::Problem problem = random_problems::make({"box", {5, 4, 3}, 4, 25, 0.5}, seed);
    const ForwardSensorModel model = of_kind(ForwardModel::beam, problem.sigma);
    const plain::Posterior plain(problem.grid, problem.measurements, model, 0.1);
    for (std::size_t i = 0; i < problem.measurements.rays.size(); ++i) {
      const auto segments = ray_segments(problem.grid, problem.measurements, problem.measurements.rays[i], model);
      const auto& steps = plain.rays()[i].steps;
      ASSERT_EQ(segments.size(), steps.size()) << "seed " << seed << ", ray " << i;
      for (std::size_t k = 0; k < steps.size(); ++k) {
        ASSERT_EQ(segments[k].voxel, steps[k].voxel) << "seed " << seed << ", ray " << i;
        ASSERT_NEAR(segments[k].enter, steps[k].enter, 1e-6);
        ASSERT_NEAR(segments[k].exit, steps[k].exit, 1e-6);
      }
    }
  }
}

TEST(RaySegments, endFourSigmaBehindTheRangeOrAtTheMaximumRange) {
  Corridor corridor;
  const ForwardSensorModel model = of_kind(ForwardModel::beam, 0.05);
  const auto last = [&](const RangeMeasurement& ray) {
    const auto segments = ray_segments(corridor.grid, corridor.measurements, ray, model);
    return segments.empty() ? -1 : static_cast<int>(segments.back().voxel);
  };
  EXPECT_EQ(last(corridor.returning(0.35)), 4) << "0.35 + 0.2 m is in voxel 4";
  EXPECT_EQ(last(corridor.returning(0.41)), 5);
  EXPECT_EQ(last(corridor.beyond()), 7);
  corridor.measurements.max_range = 0.65;
  EXPECT_EQ(last(corridor.beyond()), 5);
  const auto segments = ray_segments(corridor.grid, corridor.measurements, corridor.beyond(), model);
  EXPECT_NEAR(segments.back().exit, 0.65, 1e-6) << "what lies farther was not looked at";
}

TEST(LogLikelihood, isThePlainModelOnRandomMaps) {
  const CounterRandom random(5, 997);
  std::uint64_t draw = 0, seed = 200;
  for (const ForwardModel kind : every_model)
    for (const VoxelRange range : {VoxelRange::segment, VoxelRange::centre})
      for (int repeat = 0; repeat < 10; ++repeat) {
        const random_problems::Problem problem =
            random_problems::make({"box", {5, 4, 3}, 4, 25, 0.3 + 0.1 * repeat}, ++seed);
        ForwardSensorModel model = of_kind(kind, problem.sigma);
        model.voxel_range = range;
        model.angular_sigma = 0.2;
        model.eta_hit = 0.7;
        const plain::Posterior plain(problem.grid, problem.measurements, model, 0.1);
        plain::Levels map(problem.grid.voxel_count());
        for (std::uint8_t& level : map)
          level = random.uniform(++draw)[0] < 0.2 ? 1 + (random.uniform(draw)[1] < 0.5 && model.levels() > 2) : 0;
        for (std::size_t i = 0; i < problem.measurements.rays.size(); ++i)
          ASSERT_NEAR(log_likelihood(problem.grid, model, problem.measurements, problem.measurements.rays[i], map),
                      plain.log_likelihood(plain.rays()[i], map), 1e-5)
              << name(kind) << ", seed " << seed << ", ray " << i;
      }
}

TEST(LogLikelihood, ofThePaperByHand) {
  const Corridor corridor;
  ForwardSensorModel model = of_kind(ForwardModel::paper, 0.05);
  model.voxel_range = VoxelRange::centre;
  model.eta_hit = 2.0;
  const double constant = -std::log(0.05 * std::sqrt(2.0 * M_PI));
  std::vector<std::uint8_t> map = all_free;
  // Nothing occupied: z_exp = z_max.
  EXPECT_NEAR(corridor.log_likelihood(model, corridor.returning(0.3), map), constant - std::pow(0.9 / 0.05, 2), 1e-3);
  EXPECT_NEAR(corridor.log_likelihood(model, corridor.beyond(), map), constant, 1e-9);
  map[3] = map[5] = 1;  // the first of the two, at 0.45 m, counts
  EXPECT_NEAR(corridor.log_likelihood(model, corridor.returning(0.4), map), constant - 1.0, 1e-5);
  EXPECT_NEAR(corridor.log_likelihood(model, corridor.beyond(), map), constant - std::pow(0.75 / 0.05, 2), 1e-3);
}

TEST(LogLikelihood, ofTheConeByHand) {
  Corridor corridor;
  ForwardSensorModel model = of_kind(ForwardModel::cone, 0.05);
  model.voxel_range = VoxelRange::centre;
  model.angular_sigma = 0.1;
  std::vector<std::uint8_t> map = all_free;
  map[3] = 1;  // centre at 0.45 m
  const auto p = [&](double z) { return std::exp(corridor.log_likelihood(model, corridor.returning(z), map)); };
  EXPECT_NEAR(p(0.45), 0.5 / (1.0 + std::exp(-4.0)) + 1.0 / 3.0, 1e-5);
  EXPECT_NEAR(p(0.40), 0.5 / (1.0 + std::exp(-2.0)) + std::exp(-1.0) / 3.0, 1e-5);
  EXPECT_NEAR(p(0.35), 0.25 + std::exp(-4.0) / 3.0, 1e-5) << "2 sigma before the centre";
  EXPECT_NEAR(p(0.90), 0.5, 1e-4) << "far behind the surface";
  // A ray that passes 0.02 m beside the centre at 0.45 m: the angle counts once, whatever its direction.
  corridor.measurements.origins[0] += Vector3(0.0, 0.02, 0.0);
  const double range = std::hypot(0.45, 0.02), angle = std::atan2(0.02, 0.45) / 0.1, dz = (0.45 - range) / 0.05;
  RangeMeasurement beside = corridor.returning(0.45);
  beside.end.y() += 0.02f;
  EXPECT_NEAR(std::exp(corridor.log_likelihood(model, beside, map)),
              0.5 / (1.0 + std::exp(-(2.0 * (dz + 2.0) + angle * angle))) + std::exp(-(dz * dz + angle * angle)) / 3.0,
              1e-5);
}

}  // namespace
}  // namespace nextview

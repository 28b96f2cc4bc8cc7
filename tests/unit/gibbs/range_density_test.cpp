// The proper models: their densities integrate to what they should, and follow the surface.
#include <gtest/gtest.h>

#include <cmath>

#include "core/gibbs/forward_sensor_model.hpp"
#include "tests/unit/gibbs/plain_model.hpp"

namespace nextview {
namespace {

constexpr double max_range = 1.5;
const VoxelGrid far_corridor{0.1, {3, 0, 0}, {8, 1, 1}};  // from 0.3 to 1.1 m before the camera
const Vector3 camera(0.0, 0.06, 0.04);

RangeMeasurements one_ray(double z, bool beyond_range) {
  RangeMeasurements measurements;
  measurements.max_range = max_range;
  measurements.origins = {camera};
  RangeMeasurement ray;
  ray.end = (camera + z * Vector3::UnitX()).cast<float>();
  ray.beyond_range = beyond_range;
  measurements.rays = {ray};
  return measurements;
}

double likelihood(const ForwardSensorModel& model, double z, bool beyond_range, const plain::Levels& map) {
  const RangeMeasurements measurements = one_ray(z, beyond_range);
  return std::exp(log_likelihood(far_corridor, model, measurements, measurements.rays[0], map));
}

/// Integral of the range's density plus the probability of no return.
double total(const ForwardSensorModel& model, const plain::Levels& map) {
  constexpr int steps = 6'000;
  double sum = likelihood(model, max_range, true, map);
  for (int i = 0; i < steps; ++i)
    sum += likelihood(model, (i + 0.5) * max_range / steps, false, map) * max_range / steps;
  return sum;
}

ForwardSensorModel with_uneven_weights(ForwardModel kind, double sigma) {
  ForwardSensorModel model;
  model.kind = kind;
  model.sigma = sigma;
  model.random_weight = 0.07, model.max_weight = 0.04;
  model.attenuations = {0.3, 2.0};
  return model;
}

TEST(RangeDensity, integratesToOneWithTheNoReturns) {
  for (const VoxelRange range : {VoxelRange::segment, VoxelRange::centre})
    for (const double sigma : {0.01, 0.05}) {
      ForwardSensorModel beam = with_uneven_weights(ForwardModel::beam, sigma);
      beam.voxel_range = range;
      for (const plain::Levels& map : {plain::Levels{0, 0, 0, 0, 0, 0, 0, 0},
                                       {0, 0, 0, 1, 0, 1, 0, 0},
                                       {1, 1, 1, 1, 1, 1, 1, 1},
                                       {0, 0, 0, 0, 0, 0, 1, 0}})
        EXPECT_NEAR(total(beam, map), 1.0, 1e-3) << sigma;
      ForwardSensorModel attenuation = with_uneven_weights(ForwardModel::attenuation, sigma);
      attenuation.voxel_range = range;
      for (const plain::Levels& map : {plain::Levels{0, 0, 0, 0, 0, 0, 0, 0},
                                       {0, 0, 0, 1, 0, 2, 0, 0},
                                       {1, 1, 1, 1, 1, 1, 1, 0},
                                       {0, 1, 0, 2, 0, 2, 2, 0}})
        EXPECT_NEAR(total(attenuation, map), 1.0, 1e-3) << sigma;
    }
}

TEST(RangeDensity, ofOneVoxelIsTheMeanOfTheGaussianOverItsSegment) {
  const ForwardSensorModel model = with_uneven_weights(ForwardModel::beam, 0.02);
  const VoxelSegment segment{2, 0.5, 0.6};
  double integral = 0.0;
  for (int i = 0; i < 20'000; ++i)
    integral += hit_density(far_corridor, model, camera, segment, (i + 0.5) * 1e-4) * 1e-4;
  EXPECT_NEAR(integral, 1.0, 1e-4);
  for (const double z : {0.45, 0.5, 0.53, 0.6, 0.62}) {
    double mean = 0.0;  // midpoint rule
    for (int i = 0; i < 1'000; ++i) mean += std::exp(-0.5 * std::pow((0.5 + (i + 0.5) * 1e-4 - z) / 0.02, 2)) / 1e3;
    EXPECT_NEAR(hit_density(far_corridor, model, camera, segment, z), mean / (0.02 * std::sqrt(2.0 * M_PI)), 1e-3) << z;
  }
}

TEST(RangeDensity, withCentresIsTheGaussianAroundTheCentresDistance) {
  ForwardSensorModel model = with_uneven_weights(ForwardModel::beam, 0.02);
  model.voxel_range = VoxelRange::centre;
  const double range =
      (far_corridor.centre(2) - camera).norm();  // slightly over 0.55: the ray passes beside the centre
  const double peak = 1.0 / (0.02 * std::sqrt(2.0 * M_PI));
  EXPECT_NEAR(hit_density(far_corridor, model, camera, {2, 0.5, 0.6}, range), peak, 1e-6);
  EXPECT_NEAR(hit_density(far_corridor, model, camera, {2, 0.5, 0.6}, range + 0.02), peak * std::exp(-0.5), 1e-6);
}

TEST(RangeDensity, beamByHand) {
  const ForwardSensorModel model = with_uneven_weights(ForwardModel::beam, 0.01);
  const plain::Levels nothing(8, 0), third{0, 0, 1, 0, 0, 0, 0, 0};
  EXPECT_NEAR(likelihood(model, 0.55, false, third), 0.89 / 0.1 + 0.07 / 1.5, 1e-4) << "5 sigma from either face";
  EXPECT_NEAR(likelihood(model, 0.5, false, third), 0.89 * 0.5 / 0.1 + 0.07 / 1.5, 1e-3) << "on the near face";
  EXPECT_NEAR(likelihood(model, 0.85, false, third), 0.07 / 1.5, 1e-6) << "something at random";
  EXPECT_NEAR(likelihood(model, 0.55, false, nothing), 0.07 / 1.5, 1e-6);
  EXPECT_NEAR(likelihood(model, 1.5, true, nothing), 0.93, 1e-6);
  EXPECT_NEAR(likelihood(model, 1.5, true, third), 0.04, 1e-6);
}

TEST(RangeDensity, attenuationByHand) {
  const ForwardSensorModel model = with_uneven_weights(ForwardModel::attenuation, 0.01);
  const plain::Levels map{0, 1, 2, 0, 0, 0, 0, 0};
  const double first = 1.0 - std::exp(-0.3), second = std::exp(-0.3) * (1.0 - std::exp(-2.0));
  EXPECT_NEAR(likelihood(model, 0.45, false, map), 0.89 * first / 0.1 + 0.07 / 1.5, 1e-4);
  EXPECT_NEAR(likelihood(model, 0.55, false, map), 0.89 * second / 0.1 + 0.07 / 1.5, 1e-4);
  const double survival = std::exp(-2.3);
  EXPECT_NEAR(likelihood(model, 1.5, true, map), 0.04 * (1.0 - survival) + 0.93 * survival, 1e-6);
}

TEST(RangeDensity, aStrongAttenuationIsTheBeamModel) {
  ForwardSensorModel strong = with_uneven_weights(ForwardModel::attenuation, 0.02);
  strong.attenuations = {200.0};
  const ForwardSensorModel beam = with_uneven_weights(ForwardModel::beam, 0.02);
  const plain::Levels map{0, 0, 0, 1, 0, 1, 0, 0};
  for (const double z : {0.35, 0.58, 0.64, 0.71, 0.85, 1.2})
    EXPECT_NEAR(likelihood(strong, z, false, map), likelihood(beam, z, false, map), 1e-6) << z;
  EXPECT_NEAR(likelihood(strong, 1.5, true, map), likelihood(beam, 1.5, true, map), 1e-6);
}

TEST(RangeDensity, aReturnIsLikeliestWhereItsVoxelIsTheFirst) {
  for (const ForwardModel kind :
       {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam, ForwardModel::attenuation}) {
    ForwardSensorModel model = with_uneven_weights(kind, 0.05);
    model.angular_sigma = 0.1;
    double before = -HUGE_VAL;
    for (int voxel = 0; voxel < 8; ++voxel) {
      plain::Levels map(8, 0);
      map[voxel] = static_cast<std::uint8_t>(model.levels() - 1);
      const double value = likelihood(model, 0.65, false, map);  // voxel 3
      if (voxel < 3) {
        EXPECT_GE(value, before - 1e-3) << name(kind) << ", voxel " << voxel;  // 'cone' sinks a little far behind
      } else if (voxel == 3) {
        EXPECT_GT(value, before) << name(kind);
      } else if (voxel == 4) {
        EXPECT_LT(value, before) << name(kind);
      }
      before = value;
    }
  }
}

TEST(RangeDensity, whatStandsBehindAnOccupiedVoxelIsOfNoConsequence) {
  for (const ForwardModel kind : {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam}) {
    const ForwardSensorModel model = with_uneven_weights(kind, 0.05);
    const plain::Levels alone{0, 0, 1, 0, 0, 0, 0, 0}, crowd{0, 0, 1, 1, 0, 1, 1, 1};
    EXPECT_EQ(likelihood(model, 0.65, false, alone), likelihood(model, 0.65, false, crowd)) << name(kind);
    EXPECT_EQ(likelihood(model, 1.5, true, alone), likelihood(model, 1.5, true, crowd)) << name(kind);
  }
}

TEST(RangeDensity, aNoReturnIsLessLikelyWithEveryVoxelInTheWay) {
  const ForwardSensorModel model = with_uneven_weights(ForwardModel::attenuation, 0.02);
  plain::Levels map(8, 0);
  double before = likelihood(model, 1.5, true, map);
  for (std::uint8_t& level : map)
    for (const int next : {1, 2}) {
      level = static_cast<std::uint8_t>(next);
      const double value = likelihood(model, 1.5, true, map);
      EXPECT_LT(value, before);
      before = value;
    }
  EXPECT_GT(before, 0.04);
}

}  // namespace
}  // namespace nextview

#include "core/gibbs/exact_posterior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "tests/unit/gibbs/plain_model.hpp"
#include "tests/unit/gibbs/random_problems.hpp"
#include "tests/unit/gibbs/tested_values.hpp"

namespace nextview {
namespace {

ForwardSensorModel model_of_few_outliers(const random_problems::Problem& problem, ForwardModel kind, VoxelRange range) {
  ForwardSensorModel model;
  model.kind = kind;
  model.voxel_range = range;
  model.sigma = problem.sigma;
  model.angular_sigma = 0.3;
  model.attenuations = {0.3, 2.0};
  return model;
}

void expect_equal(const ExactPosterior& exact, const plain::Marginals& plain) {
  ASSERT_EQ(exact.occupied.size(), plain.occupied.size());
  for (std::size_t voxel = 0; voxel < plain.occupied.size(); ++voxel) {
    EXPECT_NEAR(exact.occupied[voxel], plain.occupied[voxel], 1e-6) << "voxel " << voxel;
    EXPECT_NEAR(exact.upper[voxel], plain.upper[voxel], 1e-6) << "voxel " << voxel;
    EXPECT_NEAR(exact.reach[voxel], plain.reach[voxel], 1e-6) << "voxel " << voxel;
  }
  EXPECT_NEAR(exact.log_evidence, plain.log_evidence, 1e-6);
}

void expect_equal(const random_problems::Problem& problem, const ForwardSensorModel& model, double prior) {
  expect_equal(exact_posterior(problem.grid, problem.measurements, model, prior),
               plain::enumerate(plain::Posterior(problem.grid, problem.measurements, model, prior)));
}

TEST(ExactPosterior, isThePlainEnumeration) {
  std::uint64_t seed = 0;
  for (const random_problems::Shape& shape : random_problems::small()) {
    bool centre = ++seed % 2;
    for (const ForwardModel kind : every_model) {
      centre = !centre;
      SCOPED_TRACE(shape.name + ", " + std::string(name(kind)) + (centre ? ", centre" : ", segment"));
      const random_problems::Problem problem = random_problems::make(shape, seed);
      expect_equal(problem, model_of_few_outliers(problem, kind, centre ? VoxelRange::centre : VoxelRange::segment),
                   seed % 3 == 0   ? 0.5
                   : seed % 3 == 1 ? 0.1
                                   : 0.02);
    }
  }
}

TEST(ExactPosterior, isThePlainEnumerationWhateverRaysCount) {
  for (const double independence : {0.03, 0.4}) {
    const random_problems::Problem problem = random_problems::make(random_problems::small()[4], 7);
    for (const ForwardModel kind : every_model) {
      ForwardSensorModel model = model_of_few_outliers(problem, kind, VoxelRange::segment);
      model.independence = independence;
      expect_equal(problem, model, 0.1);
    }
  }
}

// Rays that are seen twice and count half are seen once.
TEST(ExactPosterior, twiceTheRaysAtHalfTheIndependenceAreTheSame) {
  const random_problems::Problem problem = random_problems::make(random_problems::small()[4], 5);
  RangeMeasurements twice = problem.measurements;
  twice.rays.insert(twice.rays.end(), problem.measurements.rays.begin(), problem.measurements.rays.end());
  for (const ForwardModel kind : every_model) {
    ForwardSensorModel model = model_of_few_outliers(problem, kind, VoxelRange::segment);
    const ExactPosterior once = exact_posterior(problem.grid, problem.measurements, model, 0.1);
    const ExactPosterior surer = exact_posterior(problem.grid, twice, model, 0.1);
    model.independence = 0.5;
    const ExactPosterior half = exact_posterior(problem.grid, twice, model, 0.1);
    double change = 0.0;
    for (std::size_t voxel = 0; voxel < problem.grid.voxel_count(); ++voxel) {
      EXPECT_NEAR(half.occupied[voxel], once.occupied[voxel], 1e-9);
      EXPECT_NEAR(half.upper[voxel], once.upper[voxel], 1e-9);
      change = std::max(change, std::abs(surer.occupied[voxel] - once.occupied[voxel]));
    }
    EXPECT_GT(change, 0.01) << name(kind);
  }
}

TEST(ExactPosterior, isThePlainEnumerationOfAMillionMaps) {
  const random_problems::Problem problem = random_problems::make(random_problems::large()[1], 101);
  ASSERT_EQ(problem.grid.voxel_count(), 20u);
  expect_equal(problem, model_of_few_outliers(problem, ForwardModel::beam, VoxelRange::segment), 0.1);
}

TEST(ExactPosterior, aVoxelOfNoRayKeepsThePrior) {
  const VoxelGrid grid{0.1, {0, 0, 0}, {2, 2, 2}};
  RangeMeasurements nothing;
  for (const ForwardModel kind : every_model) {
    ForwardSensorModel model;
    model.kind = kind;
    const ExactPosterior exact = exact_posterior(grid, nothing, model, 0.2);
    for (std::size_t voxel = 0; voxel < grid.voxel_count(); ++voxel) {
      EXPECT_NEAR(exact.occupied[voxel], 0.2, 1e-12);
      EXPECT_NEAR(exact.upper[voxel], model.levels() == 3 ? 0.1 : 0.2, 1e-12);
      EXPECT_EQ(exact.reach[voxel], 0.0);
    }
    EXPECT_NEAR(exact.log_evidence, 0.0, 1e-12);
  }
}

/// Two voxels, one ray: few enough maps for paper and pencil.
TEST(ExactPosterior, oneReturnInTwoVoxelsByHand) {
  const VoxelGrid grid{0.1, {0, 0, 0}, {2, 1, 1}};
  RangeMeasurements measurements;
  measurements.max_range = 1.0;
  measurements.origins = {{-0.1, 0.05, 0.05}};
  measurements.rays = {{{0.05f, 0.05f, 0.05f}}};  // z = 0.15: the middle of the first voxel
  ForwardSensorModel model;
  model.kind = ForwardModel::beam;
  model.sigma = 0.05;
  const double in_first = std::erf(1.0 / std::sqrt(2.0)) / 0.1;    // one sigma to either side
  const double in_second = (0.99865010197 - 0.84134474607) / 0.1;  // from one to three sigma
  const double first = 0.9 * in_first + 0.05, second = 0.9 * in_second + 0.05, none = 0.05;
  // Prior 0.2: maps 00, 10, 01, 11.
  const double p00 = 0.64 * none, p10 = 0.16 * first, p01 = 0.16 * second, p11 = 0.04 * first;
  const double evidence = p00 + p10 + p01 + p11;
  const ExactPosterior exact = exact_posterior(grid, measurements, model, 0.2);
  EXPECT_NEAR(exact.occupied[0], (p10 + p11) / evidence, 1e-5);
  EXPECT_NEAR(exact.occupied[1], (p01 + p11) / evidence, 1e-5);
  EXPECT_NEAR(exact.reach[0], 1.0, 1e-12);
  EXPECT_NEAR(exact.reach[1], (p00 + p01) / evidence, 1e-5);
  EXPECT_NEAR(exact.log_evidence, std::log(evidence), 1e-5);
}

TEST(ExactPosterior, weightsCountRays) {
  random_problems::Problem problem = random_problems::make(random_problems::small()[4], 5);
  for (const ForwardModel kind : every_model) {
    const ForwardSensorModel model = model_of_few_outliers(problem, kind, VoxelRange::segment);
    RangeMeasurements thrice = problem.measurements, weighted = problem.measurements;
    for (int copy = 0; copy < 2; ++copy)
      thrice.rays.insert(thrice.rays.end(), problem.measurements.rays.begin(), problem.measurements.rays.end());
    for (RangeMeasurement& ray : weighted.rays) ray.weight = 3;
    const ExactPosterior a = exact_posterior(problem.grid, thrice, model, 0.1);
    const ExactPosterior b = exact_posterior(problem.grid, weighted, model, 0.1);
    for (std::size_t voxel = 0; voxel < problem.grid.voxel_count(); ++voxel) {
      EXPECT_NEAR(a.occupied[voxel], b.occupied[voxel], 1e-9);
      EXPECT_NEAR(a.reach[voxel], b.reach[voxel], 1e-9);
    }
    EXPECT_NEAR(a.log_evidence, b.log_evidence, 1e-9);
  }
}

TEST(ExactPosterior, moreThan2To20MapsAreRefused) {
  RangeMeasurements nothing;
  ForwardSensorModel model;
  model.kind = ForwardModel::beam;
  EXPECT_NO_THROW(exact_posterior({0.1, {0, 0, 0}, {5, 4, 1}}, nothing, model, 0.1));
  EXPECT_THROW(exact_posterior({0.1, {0, 0, 0}, {7, 3, 1}}, nothing, model, 0.1), std::invalid_argument);
  EXPECT_THROW(exact_posterior({0.1, {0, 0, 0}, {1000, 1000, 1000}}, nothing, model, 0.1), std::invalid_argument);
  model.kind = ForwardModel::attenuation;  // 3^13 > 2^20 > 3^12
  EXPECT_NO_THROW(exact_posterior({0.1, {0, 0, 0}, {4, 3, 1}}, nothing, model, 0.1));
  EXPECT_THROW(exact_posterior({0.1, {0, 0, 0}, {13, 1, 1}}, nothing, model, 0.1), std::invalid_argument);
}

TEST(ExactPosterior, parametersOutOfBoundsAreRefused) {
  for (const double independence : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    ForwardSensorModel wrong;
    wrong.independence = independence;
    EXPECT_THROW(exact_posterior({0.1, {0, 0, 0}, {2, 1, 1}}, {}, wrong, 0.1), std::invalid_argument) << independence;
  }

  const VoxelGrid grid{0.1, {0, 0, 0}, {2, 1, 1}};
  RangeMeasurements nothing;
  const ForwardSensorModel model;
  for (const double prior : {0.0, 1.0, -0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(exact_posterior(grid, nothing, model, prior), std::invalid_argument) << prior;
  for (const double sigma : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    ForwardSensorModel wrong = model;
    wrong.sigma = sigma;
    EXPECT_THROW(exact_posterior(grid, nothing, wrong, 0.1), std::invalid_argument) << sigma;
  }
}

}  // namespace
}  // namespace nextview

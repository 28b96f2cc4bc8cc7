// The bar of posterior_sampler_test.cpp can fail: a right sampler passes it, subtly wrong ones do not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/gibbs/marginal_comparison.hpp"
#include "tests/unit/gibbs/plain_model.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using plain::Conditional;
using plain::Levels;

/// A test problem with outliers, misses and rays that cross, and the model that it is judged by.
struct ModelledProblem {
  random_problems::Problem problem;
  ForwardSensorModel model;
  double prior = 0.2;

  explicit ModelledProblem(ForwardModel kind)
      : problem(random_problems::make({"oblong", {4, 2, 1}, 2, 9, 0.7}, 12)),
        model(random_problems::model_for(problem, kind)) {}
  plain::Posterior posterior() const { return {problem.grid, problem.measurements, model, prior}; }
};

/// Samples with this conditional in place of the right one and compares as the bar does.
MarginalComparison compare_sampled(const ModelledProblem& right, const Conditional& conditional) {
  const plain::Posterior posterior = right.posterior();
  std::vector<Estimate> runs;
  for (const plain::Marginals& run : plain::gibbs_sampler(posterior, conditional, 200'000, 8, 1))
    runs.push_back(report(run));
  return compare(plain::enumerate(posterior), runs);
}

class Conditionals : public ::testing::TestWithParam<ForwardModel> {
 protected:
  const ModelledProblem right{GetParam()};

  void expect_caught(const Conditional& broken) const {
    const MarginalComparison comparison = compare_sampled(right, broken);
    EXPECT_FALSE(comparison.agrees());
    EXPECT_GT(comparison.largest_difference, 4.0 * comparison.standard_error) << "by chance";
    fmt::print("             caught by {:.3f}: {}\n", comparison.largest_difference, comparison.where);
  }
  void expect_caught(const ModelledProblem& wrong) const {
    const plain::Posterior posterior = wrong.posterior();
    expect_caught(plain::full_conditional(posterior));
  }
};

class ConditionalsWithAFloor : public Conditionals {};
class ConditionalsOfSeveralLevels : public Conditionals {};

TEST_P(Conditionals, theRightOnePasses) {
  const plain::Posterior posterior = right.posterior();
  const MarginalComparison comparison = compare_sampled(right, plain::full_conditional(posterior));
  EXPECT_TRUE(comparison.agrees()) << comparison.where;
  EXPECT_LT(comparison.standard_error, 0.0025);
  fmt::print("             largest difference {:.4f}, standard error {:.4f}\n", comparison.largest_difference,
             comparison.standard_error);
}

TEST_P(Conditionals, oneThatForgetsWhatBlocksARayIsCaught) {
  const plain::Posterior posterior = right.posterior();
  expect_caught([&](const Levels& map, std::uint32_t voxel) {
    std::vector<double> weights;
    for (int level = 0; level < posterior.levels(); ++level) {
      double sum = posterior.log_prior(level);
      for (const plain::Ray& ray : posterior.rays()) {
        Levels seen = map;  // with nothing before the voxel
        bool on_ray = false;
        for (const plain::Step& step : ray.steps) {
          if ((on_ray = step.voxel == voxel)) break;
          seen[step.voxel] = 0;
        }
        seen[voxel] = static_cast<std::uint8_t>(level);
        if (on_ray) sum += ray.weight * posterior.log_likelihood(ray, seen);
      }
      weights.push_back(std::exp(sum));
    }
    return weights;
  });
}

TEST_P(ConditionalsWithAFloor, oneWithoutTheFloorIsCaught) {
  ModelledProblem wrong = right;
  wrong.model.random_weight = 1e-9;
  expect_caught(wrong);
}

TEST_P(Conditionals, oneThatCountsThePriorTwiceIsCaught) {
  const plain::Posterior posterior = right.posterior();
  const Conditional once = plain::full_conditional(posterior);
  expect_caught([&](const Levels& map, std::uint32_t voxel) {
    std::vector<double> weights = once(map, voxel);
    for (int level = 0; level < posterior.levels(); ++level) weights[level] *= std::exp(posterior.log_prior(level));
    return weights;
  });
}

TEST_P(Conditionals, oneThatTakesDependentRaysForIndependentIsCaught) {
  ModelledProblem dependent = right;
  dependent.model.independence = 0.4;
  const plain::Posterior posterior = right.posterior(), expected = dependent.posterior();
  std::vector<Estimate> runs;
  for (const plain::Marginals& run : plain::gibbs_sampler(posterior, plain::full_conditional(posterior), 50'000, 8, 1))
    runs.push_back(report(run));
  const MarginalComparison comparison = compare(plain::enumerate(expected), runs);
  EXPECT_FALSE(comparison.agrees());
  EXPECT_GT(comparison.largest_difference, 4.0 * comparison.standard_error) << "by chance";
}

TEST_P(Conditionals, oneThatForgetsARayIsCaught) {
  ModelledProblem wrong = right;
  wrong.problem.measurements.rays.erase(wrong.problem.measurements.rays.begin() + 8);
  expect_caught(wrong);
}

TEST_P(Conditionals, oneThatIgnoresNoReturnsIsCaught) {
  ModelledProblem wrong = right;
  EXPECT_GT(std::erase_if(wrong.problem.measurements.rays, [](const auto& ray) { return ray.beyond_range; }), 0u);
  expect_caught(wrong);
}

TEST_P(ConditionalsOfSeveralLevels, oneThatTakesTheUpperLevelForOccupiedIsCaught) {
  const plain::Posterior posterior = right.posterior();
  const Conditional full = plain::full_conditional(posterior);
  expect_caught([&](const Levels& map, std::uint32_t voxel) {
    std::vector<double> weights = full(map, voxel);
    weights[1] = weights[2];
    return weights;
  });
}

std::string name_of(const ::testing::TestParamInfo<ForwardModel>& parameter) {
  return std::string(name(parameter.param));
}

INSTANTIATE_TEST_SUITE_P(EveryModel, Conditionals,
                         ::testing::Values(ForwardModel::paper, ForwardModel::cone, ForwardModel::beam,
                                           ForwardModel::attenuation),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Mixtures, ConditionalsWithAFloor,
                         ::testing::Values(ForwardModel::beam, ForwardModel::attenuation), name_of);
INSTANTIATE_TEST_SUITE_P(Mixtures, ConditionalsOfSeveralLevels, ::testing::Values(ForwardModel::attenuation), name_of);

}  // namespace
}  // namespace nextview

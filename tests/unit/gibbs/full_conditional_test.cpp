#include "core/gibbs/full_conditional.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "core/gibbs/exact_posterior.hpp"
#include "core/gibbs/first_hit_state.hpp"
#include "core/gibbs/survival_state.hpp"
#include "tests/unit/gibbs/plain_model.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using random_problems::Problem;

constexpr double prior = 0.2;

plain::Levels random_map(const Problem& problem, const ForwardSensorModel& model, std::mt19937& random) {
  plain::Levels map(problem.grid.voxel_count());
  for (auto& level : map) level = random() % 3 == 0 ? std::uint8_t(1 + random() % (model.levels() - 1)) : 0;
  return map;
}

double log_sum(const std::vector<double>& logs) {
  const double largest = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double l : logs) sum += std::exp(l - largest);
  return largest + std::log(sum);
}

class FullConditionals : public ::testing::TestWithParam<ForwardModel> {};
INSTANTIATE_TEST_SUITE_P(every, FullConditionals,
                         ::testing::Values(ForwardModel::paper, ForwardModel::cone, ForwardModel::beam,
                                           ForwardModel::attenuation),
                         [](const auto& kind) { return std::string(name(kind.param)); });

// Against the equations written down once more, with rays of their own: every voxel of random maps of every test
// problem.
TEST_P(FullConditionals, AreThoseOfTheEquations) {
  std::mt19937 random(1);
  std::size_t undecided = 0;
  for (const VoxelRange range : {VoxelRange::segment, VoxelRange::centre})
    for (const random_problems::Shape& shape : random_problems::small()) {
      const Problem problem = random_problems::make(shape, 3);
      const ForwardSensorModel model = model_for(problem, GetParam(), range, shape.weights ? 0.3 : 1.0);
      const plain::Posterior plain(problem.grid, problem.measurements, model, prior);
      for (int map_number = 0; map_number < 4; ++map_number) {
        const plain::Levels map = random_map(problem, model, random);
        for (std::uint32_t v = 0; v < map.size(); ++v) {
          const FullConditional found = full_conditional(problem.grid, problem.measurements, model, prior, map, v);
          const auto expected = plain.log_conditional(map, v);
          ASSERT_EQ(found.probability.size(), expected.size());
          for (int q = 0; q < model.levels(); ++q)
            ASSERT_NEAR(found.probability[q], std::exp(expected[q] - log_sum(expected)), 1e-7) << shape.name;
          undecided += found.probability[0] > 0.01 && found.probability[0] < 0.99;
        }
      }
    }
  EXPECT_GT(undecided, 100u);
}

// All other voxels known: what is left to enumerate is the voxel itself. The joint is the definition's.
TEST_P(FullConditionals, FollowFromTheJointProbabilityOfAllMaps) {
  const Problem problem = random_problems::make({"square", {3, 2, 1}, 2, 6, 0.8}, 5);
  const ForwardSensorModel model = model_for(problem, GetParam());
  const plain::Posterior plain(problem.grid, problem.measurements, model, prior);
  // p(m_v) = sum over the other voxels of p(m_v | others) p(others): the marginals come out of the conditionals.
  std::vector<plain::Levels> maps(1, plain::Levels(problem.grid.voxel_count()));
  for (std::size_t v = 0; v < problem.grid.voxel_count(); ++v)
    for (std::size_t n = 0, count = maps.size(); n < count; ++n)
      for (int q = 1; q < model.levels(); ++q) {
        maps.push_back(maps[n]);
        maps.back()[v] = static_cast<std::uint8_t>(q);
      }
  std::vector<double> joint;
  for (const plain::Levels& map : maps) joint.push_back(plain.log_joint(map));
  const double evidence = log_sum(joint);
  const ExactPosterior exact = exact_posterior(problem.grid, problem.measurements, model, prior);
  for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
    double occupied = 0.0;
    for (std::size_t n = 0; n < maps.size(); ++n)
      occupied += std::exp(joint[n] - evidence) *
                  (1.0 - full_conditional(problem.grid, problem.measurements, model, prior, maps[n], v).probability[0]);
    EXPECT_NEAR(occupied, exact.occupied[v], 1e-7) << v;
  }
}

TEST_P(FullConditionals, AddUpRayByRay) {
  std::mt19937 random(2);
  const Problem problem = random_problems::make({"room", {8, 6, 4}, 4, 300, 0.4, true}, 7);
  const ForwardSensorModel model = model_for(problem, GetParam());
  const plain::Levels map = random_map(problem, model, random);
  std::size_t rays = 0, for_it = 0, against_it = 0;
  for (std::uint32_t v = 0; v < map.size(); ++v) {
    const FullConditional found = full_conditional(problem.grid, problem.measurements, model, prior, map, v);
    EXPECT_NEAR(std::accumulate(found.probability.begin(), found.probability.end(), 0.0), 1.0, 1e-12);
    for (int q = 1; q < model.levels(); ++q) EXPECT_LE(found.probability[q], found.probability[found.level]);
    double sum = found.log_prior_odds;
    for (std::size_t k = 0; k < found.rays.size(); ++k) {
      const RayEvidence& e = found.rays[k];
      sum += e.log_ratio;
      for_it += e.log_ratio > 1e-6, against_it += e.log_ratio < -1e-6;
      EXPECT_LT(e.enter, e.exit);
      EXPECT_TRUE(k == 0 || found.rays[k - 1].ray < e.ray);
      const RangeMeasurement& ray = problem.measurements.rays[e.ray];
      const Vector3 middle =
          problem.measurements.origins[ray.origin] + 0.5 * (e.enter + e.exit) * problem.measurements.direction(ray);
      EXPECT_LT((middle - problem.grid.centre(v)).cwiseAbs().maxCoeff(), 0.5 * problem.grid.resolution + 1e-9);
    }
    if (found.probability[0] > 1e-12 && found.probability[found.level] > 1e-12) {
      EXPECT_NEAR(sum, std::log(found.probability[found.level] / found.probability[0]), 1e-6);
    }
    rays += found.rays.size();
  }
  // No ray is forgotten.
  std::size_t crossings = 0;
  for (const RangeMeasurement& ray : problem.measurements.rays)
    crossings += ray_segments(problem.grid, problem.measurements, ray, model).size();
  EXPECT_EQ(rays, crossings);
  EXPECT_GT(for_it, 100u);
  EXPECT_GT(against_it, 100u);
}

/// The sampler's own conditional, from its lists and state: p of each level.
template <class State>
std::vector<double> sampled_from(const Problem& problem, const ForwardSensorModel& model, const plain::Levels& map,
                                 std::uint32_t v) {
  const RayLists lists(problem.grid, problem.measurements, model);
  State state(lists, model);
  state.reset(map);
  std::vector<double> logs(model.levels() - 1, std::log(prior / (model.levels() - 1) / (1.0 - prior)));
  state.conditional(v, -std::numeric_limits<double>::infinity(), logs);
  logs.insert(logs.begin(), 0.0);
  const double sum = log_sum(logs);
  for (double& l : logs) l = std::exp(l - sum);
  return logs;
}

TEST_P(FullConditionals, ListsTellWhatTheyTake) {
  const Problem problem = random_problems::make({"oblong", {6, 5, 2}, 3, 60, 0.6, true}, 11);
  const RayLists lists(problem.grid, problem.measurements, model_for(problem, GetParam(), VoxelRange::segment, 1.0));
  std::size_t in_front = 0, near = 0;
  for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v)
    in_front += lists.front(v).size(), near += lists.near(v).size();
  const std::size_t of_rays = lists.rays() * (sizeof(RangeMeasurement) + 12);  // three indices each
  EXPECT_EQ(lists.bytes(), 4 * in_front + 20 * near + of_rays + 8 * problem.grid.voxel_count());
}

TEST_P(FullConditionals, AreWhatTheSamplerDrawsFrom) {
  std::mt19937 random(4);
  const Problem problem = random_problems::make({"oblong", {6, 5, 2}, 3, 60, 0.6, true}, 11);
  for (int map_number = 0; map_number < 8; ++map_number) {
    const ForwardSensorModel model =
        model_for(problem, GetParam(), VoxelRange::segment, std::array{1.0, 0.02, 0.2, 0.7}[map_number % 4]);
    const plain::Levels map = random_map(problem, model, random);
    for (std::uint32_t v = 0; v < map.size(); ++v) {
      const FullConditional found = full_conditional(problem.grid, problem.measurements, model, prior, map, v);
      const auto expected = model.is_first_hit() ? sampled_from<FirstHitState>(problem, model, map, v)
                                                 : sampled_from<SurvivalState>(problem, model, map, v);
      for (int q = 0; q < model.levels(); ++q)  // the lists round chords and densities
        ASSERT_NEAR(found.probability[q], expected[q], 5e-3) << "voxel " << v << " level " << q;
    }
  }
}

TEST(FullConditional, WithoutARayIsThePrior) {
  const VoxelGrid grid{0.1, {0, 0, 0}, {4, 4, 1}};
  RangeMeasurements measurements;
  measurements.origins = {{-0.3, 0.05, 0.05}};
  measurements.rays = {{{0.25f, 0.05f, 0.05f}}};  // along the first row, as far as its third voxel
  const ForwardSensorModel model;
  std::vector<std::uint8_t> map(16);
  map[2] = 1;
  for (const std::uint32_t v : {3u, 5u, 15u}) {
    const FullConditional found = full_conditional(grid, measurements, model, prior, map, v);
    EXPECT_TRUE(found.rays.empty());
    EXPECT_NEAR(found.probability[0], 1.0 - prior, 1e-12);
    EXPECT_NEAR(found.probability[1], 0.5 * prior, 1e-12);
  }
  for (const std::uint32_t v : {0u, 1u}) {
    const FullConditional found = full_conditional(grid, measurements, model, prior, map, v);
    ASSERT_EQ(found.rays.size(), 1u);
    EXPECT_LT(found.rays[0].log_ratio, 0.0) << "the ray passes";
  }
  const FullConditional end = full_conditional(grid, measurements, model, prior, map, 2);
  EXPECT_GT(end.rays.at(0).log_ratio, 0.0) << "the ray ends here";
}

TEST(FullConditional, RefusesWhatIsOfAnotherGrid) {
  const Problem problem = random_problems::make({"square", {3, 3, 1}, 2, 6, 0.8}, 1);
  const ForwardSensorModel model;
  const std::vector<std::uint8_t> map(9), short_map(8), unknown_level(9, 3);
  const auto call = [&](const auto& levels, double p, std::uint32_t v) {
    return full_conditional(problem.grid, problem.measurements, model, p, levels, v);
  };
  EXPECT_NO_THROW(call(map, prior, 8));
  EXPECT_THROW(call(map, prior, 9), std::invalid_argument);
  EXPECT_THROW(call(short_map, prior, 0), std::invalid_argument);
  EXPECT_THROW(call(unknown_level, prior, 0), std::invalid_argument);
  EXPECT_THROW(call(map, 0.0, 0), std::invalid_argument);
  EXPECT_THROW(call(map, 1.0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

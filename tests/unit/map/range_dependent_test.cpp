#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/map/occupancy_map.hpp"
#include "tests/unit/map/random_scans.hpp"

// Inverse sensor models whose terms depend on the range.
namespace nextview {
namespace {

/// Eight voxels of 10 cm in a row along x, from x = 0 on.
VoxelGrid row() {
  VoxelGrid grid;
  grid.resolution = 0.1;
  grid.size = {8, 1, 1};
  return grid;
}

InverseSensorModel model_with_decays(double hit_decay, double miss_decay) {
  InverseSensorModel model;
  model.hit_decay = hit_decay;
  model.miss_decay = miss_decay;
  return model;
}

std::vector<Scan> scans() {
  std::mt19937 random(5);
  std::vector<Scan> result;
  for (const Vector3& origin : random_scans::origins()) {
    result.push_back(random_scans::scan(random, origin, 0.02, 800));
    random_scans::add_passes(result.back(), random, 300);
  }
  return result;
}

bool same_log_odds(const OccupancyMap& a, const OccupancyMap& b) {
  return std::ranges::equal(a.voxels(), b.voxels(), {}, &Voxel::log_odds, &Voxel::log_odds) &&
         std::ranges::equal(a.voxels(), b.voxels(), {}, &Voxel::probability, &Voxel::probability) &&
         std::ranges::equal(a.voxels(), b.voxels(), {}, &Voxel::measured, &Voxel::measured);
}

VoxelGrid cube() { return region_of_interest(Vector3(0.013, -0.02, 0.04), 0.44, 0.02); }

TEST(RangeDependentModel, TermsAreThoseOfTheProbabilitiesAtOneMetre) {
  const InverseSensorModel model = model_with_decays(0.5, -0.25);
  EXPECT_EQ(model.hit_term(1.0), log_odds(0.7));
  EXPECT_EQ(model.miss_term(1.0), log_odds(0.4));
  EXPECT_NEAR(model.hit_term(3.0), std::log(7.0 / 3.0) / std::exp(1.0), 1e-12);
  EXPECT_NEAR(model.miss_term(3.0), std::log(2.0 / 3.0) * std::exp(0.5), 1e-12);
  EXPECT_EQ(InverseSensorModel().hit_term(0.3), log_odds(0.7));  // at any range, to the bit
  EXPECT_EQ(InverseSensorModel().miss_term(7.0), log_odds(0.4));
}

TEST(RangeDependentModel, TermsStayFiniteAndKeepTheirSignHoweverFar) {
  for (const double decay : {-5.0, 5.0}) {
    const InverseSensorModel model = model_with_decays(decay, decay);
    const auto hit = static_cast<float>(model.hit_term(1000.0)), miss = static_cast<float>(model.miss_term(1000.0));
    EXPECT_TRUE(std::isfinite(hit) && hit > 0.0f) << hit;
    EXPECT_TRUE(std::isfinite(miss) && miss < 0.0f) << miss;
  }
}

// The camera stands 0.35 m in front of the row: voxel n's centre is 0.4 m + n * 0.1 m away.
TEST(RangeDependentModel, AVoxelTakesTheTermOfItsCentresRange) {
  OccupancyMap map(row(), model_with_decays(0.5, -0.25));
  const Scan scan{{-0.35, 0.05, 0.05}, {{0.42f, 0.05f, 0.05f}}, {}, 2.0};
  map.insert(scan);
  EXPECT_NEAR(map.log_odds(0), std::log(2.0 / 3.0) * std::exp(0.25 * (0.4 - 1.0)), 1e-6);
  EXPECT_NEAR(map.log_odds(3), std::log(2.0 / 3.0) * std::exp(0.25 * (0.7 - 1.0)), 1e-6);
  EXPECT_NEAR(map.log_odds(4), std::log(7.0 / 3.0) * std::exp(-0.5 * (0.8 - 1.0)), 1e-6);
  EXPECT_EQ(map.log_odds(5), 0.0f);

  const Scan from_afar{{-1.35, 0.05, 0.05}, {{0.42f, 0.05f, 0.05f}}, {}, 2.0};
  map.insert(from_afar);
  const double both = std::log(7.0 / 3.0) * (std::exp(0.1) + std::exp(-0.4));
  EXPECT_NEAR(map.log_odds(4), both, 1e-6);
  EXPECT_NEAR(map.voxels()[4].probability, 1.0 / (1.0 + std::exp(-both)), 1e-6);
}

TEST(RangeDependentModel, RegisteringLocalMapsGivesTheSameMap) {
  for (const auto& model : {model_with_decays(1.0, 0.4), model_with_decays(-5.0, 5.0)}) {
    OccupancyMap direct(cube(), model), registered(cube(), model), without(cube(), {});
    for (const Scan& scan : scans()) {
      direct.insert(scan);
      without.insert(scan);
      OccupancyMap local(cube(), model);
      local.insert(scan);
      registered.register_local(local, scan.origin);
      ASSERT_TRUE(same_log_odds(direct, registered));
    }
    EXPECT_FALSE(same_log_odds(direct, without));
  }
}

// A decay too small to move a term: the map that asks for each voxel's range against the one that does not.
TEST(RangeDependentModel, AVanishingDecayGivesTheMapWithoutToTheBit) {
  const InverseSensorModel vanishing = model_with_decays(1e-300, -1e-300);
  ASSERT_TRUE(vanishing.range_dependent());
  ASSERT_FALSE(InverseSensorModel().range_dependent());
  OccupancyMap with(cube(), vanishing), without(cube(), {});
  for (int round = 0; round < 3; ++round)
    for (const Scan& scan : scans()) {
      with.insert(scan);
      without.insert(scan);
      ASSERT_TRUE(same_log_odds(with, without));
    }
}

TEST(RangeDependentModel, RejectsDecaysOutOfBounds) {
  for (const double bad : {-5.001, 5.001, double(INFINITY), std::nan("")}) {
    EXPECT_THROW(model_with_decays(bad, 0.0).validate(), std::invalid_argument) << bad;
    EXPECT_THROW(model_with_decays(0.0, bad).validate(), std::invalid_argument) << bad;
  }
  EXPECT_NO_THROW(model_with_decays(-5.0, 5.0).validate());
}

}  // namespace
}  // namespace nextview

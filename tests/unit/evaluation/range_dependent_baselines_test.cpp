#include <gtest/gtest.h>

#include <cmath>

#include "core/evaluation/baseline_maps.hpp"
#include "core/map/occupancy_map.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

InverseSensorModel decaying() {
  InverseSensorModel model;
  model.hit_decay = 0.8;
  model.miss_decay = -0.5;
  return model;
}

// Voxel 0 of three, 10 cm each, is 0.4 m from the camera, voxel 1 is 0.5 m.
TEST(RangeDependentBaselines, PerRayAddsEachRaysTermOfTheVoxelsRange) {
  VoxelGrid grid;
  grid.resolution = 0.1;
  grid.size = {3, 1, 1};
  const std::vector<Scan> scans = {
      {{-0.35, 0.05, 0.05}, {{0.05f, 0.05f, 0.05f}, {0.15f, 0.05f, 0.05f}, {0.17f, 0.05f, 0.05f}}, {}, 2.0}};
  InverseSensorModel model = decaying();
  model.clamp_min = 1e-6;
  model.clamp_max = 1.0 - 1e-6;
  const std::vector<Voxel> map = BaselineMaps(grid, scans, model).make(BaselineMap::per_ray);
  const double hit = std::log(7.0 / 3.0), miss = std::log(2.0 / 3.0);
  const double first = hit * std::exp(0.8 * 0.6) + 2.0 * miss * std::exp(-0.5 * 0.6);
  EXPECT_NEAR(map[0].probability, 1.0 / (1.0 + std::exp(-first)), 1e-6);
  EXPECT_NEAR(map[1].probability, 1.0 / (1.0 + std::exp(-2.0 * hit * std::exp(0.8 * 0.5))), 1e-6);
  EXPECT_FALSE(map[2].measured);
}

TEST(RangeDependentBaselines, NoClampsIsTheOccupancyMapBeforeItMeetsItsClamps) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.6, 0.02);
  std::mt19937 random(3);
  std::vector<Scan> scans;
  for (const Vector3& origin : random_scans::origins()) {
    scans.push_back(random_scans::scan(random, origin, grid.resolution, 400));
    random_scans::add_passes(scans.back(), random, 50);
  }
  InverseSensorModel wide = decaying();
  wide.clamp_min = 1e-9;
  wide.clamp_max = 1.0 - 1e-9;
  OccupancyMap map(grid, wide);
  for (const Scan& scan : scans) map.insert(scan);
  const BaselineMaps baselines(grid, scans, wide);
  const std::vector<Voxel> no_clamps = baselines.make(BaselineMap::no_clamps);
  const std::vector<Voxel> octomap = baselines.make(BaselineMap::octomap);
  std::size_t measured = 0;
  for (std::size_t v = 0; v < no_clamps.size(); ++v) {
    ASSERT_EQ(no_clamps[v].measured, map.voxels()[v].measured) << v;
    ASSERT_NEAR(no_clamps[v].probability, map.voxels()[v].probability, 1e-6) << v;
    ASSERT_EQ(octomap[v].probability, map.voxels()[v].probability) << v;
    measured += map.voxels()[v].measured;
  }
  EXPECT_GT(measured, 5000u);
}

}  // namespace
}  // namespace nextview

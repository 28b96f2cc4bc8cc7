#include "core/evaluation/baseline_maps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

#include "core/map/occupancy_map.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

constexpr double max_range = 2.0;  // [m]

/// Eight voxels of 10 cm in a row along x, from x = 0 on, seen from x = -0.35 m.
VoxelGrid row() {
  VoxelGrid grid;
  grid.resolution = 0.1;
  grid.size = {8, 1, 1};
  return grid;
}

Eigen::Vector3f at(double x) { return {static_cast<float>(x), 0.05f, 0.05f}; }

Scan scan(const std::vector<double>& hits, const std::vector<double>& misses = {}) {
  Scan result;
  result.origin = {-0.35, 0.05, 0.05};
  result.max_range = max_range;
  for (const double x : hits) result.hits.push_back(at(x));
  for (const double x : misses) result.misses.push_back(at(x));
  return result;
}

void expect_near(const std::vector<Voxel>& voxels, const std::vector<double>& expected) {
  ASSERT_EQ(voxels.size(), expected.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) EXPECT_NEAR(voxels[i].probability, expected[i], 2e-6) << i;
}

// A hit multiplies the odds by 7/3, a miss by 2/3.
double from_odds(double odds) { return odds / (1.0 + odds); }
double hits_and_misses(int hits, int misses) {
  return from_odds(std::pow(7.0 / 3.0, hits) * std::pow(2.0 / 3.0, misses));
}

TEST(BaselineMaps, RaysAreCountedPerRayAndPerScan) {
  const std::vector<Scan> scans = {
      scan({0.45, 0.43, 0.55}, {0.25}),  // a miss given up in voxel 2
      scan({0.25, 9.0, 0.95}),           // beyond range, and beyond the grid: both carve only
      scan({0.45}),
  };
  const BaselineMaps maps(row(), scans);
  // 0: all pass; 2: three pass, one ends, two pass, one passes; 4: two end, one passes, two pass, one ends
  const std::vector<std::array<unsigned, 4>> expected = {{0, 8, 0, 3}, {0, 8, 0, 3}, {1, 6, 1, 2}, {0, 6, 0, 3},
                                                         {3, 3, 2, 1}, {1, 2, 1, 1}, {0, 2, 0, 1}, {0, 2, 0, 1}};
  ASSERT_EQ(maps.counts().size(), 8u);
  for (std::size_t v = 0; v < 8; ++v) {
    const RayCounts& c = maps.counts()[v];
    EXPECT_EQ((std::array<unsigned, 4>{c.hits, c.misses, c.scan_hits, c.scan_misses}), expected[v]) << v;
  }
}

TEST(BaselineMaps, OctomapAndNoClampsAreSumsOverScans) {
  const std::vector<Scan> scans = {scan({0.45, 0.43, 0.55}, {0.25}), scan({0.25, 9.0, 0.95}), scan({0.45})};
  const BaselineMaps maps(row(), scans);
  const std::vector<double> expected = {hits_and_misses(0, 3), hits_and_misses(0, 3), hits_and_misses(1, 2),
                                        hits_and_misses(0, 3), hits_and_misses(2, 1), hits_and_misses(1, 1),
                                        hits_and_misses(0, 1), hits_and_misses(0, 1)};
  expect_near(maps.make(BaselineMap::octomap), expected);  // too few scans to meet the clamps
  expect_near(maps.make(BaselineMap::no_clamps), expected);
}

TEST(BaselineMaps, OnlyOctomapIsClamped) {
  std::vector<Scan> scans(12, scan({0.25}));
  for (int i = 0; i < 2; ++i) scans.push_back(scan({0.55}));
  const BaselineMaps maps(row(), scans);
  // 0 and 1: 14 misses; 2: 12 hits, to the upper clamp, then two misses; 3 and 4: two misses; 5: two hits
  const double two_misses = hits_and_misses(0, 2), two_hits = hits_and_misses(2, 0), never = 0.5;
  const double from_clamp = from_odds(0.97 / 0.03 * 4.0 / 9.0);
  expect_near(maps.make(BaselineMap::octomap),
              {0.12, 0.12, from_clamp, two_misses, two_misses, two_hits, never, never});
  const double misses = hits_and_misses(0, 14);
  expect_near(maps.make(BaselineMap::no_clamps),
              {misses, misses, hits_and_misses(12, 2), two_misses, two_misses, two_hits, never, never});
}

TEST(BaselineMaps, PerRayUpdatesWithEveryRay) {
  InverseSensorModel wide;
  wide.clamp_min = 1e-6;
  wide.clamp_max = 1.0 - 1e-6;
  const std::vector<Scan> scans = {scan({0.45, 0.43, 0.55}, {0.25}), scan({0.25, 9.0, 0.95}), scan({0.45})};
  const BaselineMaps maps(row(), scans, wide);
  expect_near(maps.make(BaselineMap::per_ray),
              {hits_and_misses(0, 8), hits_and_misses(0, 8), hits_and_misses(1, 6), hits_and_misses(0, 6),
               hits_and_misses(3, 3), hits_and_misses(1, 2), hits_and_misses(0, 2), hits_and_misses(0, 2)});
}

TEST(BaselineMaps, PerRayIsClampedAfterEachRayInTheirOrder) {
  // One scan: voxel 2 is hit seven times, to the clamp, then passed once; voxel 3 is hit, then missed.
  const std::vector<Scan> scans = {
      scan({0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.35}, {0.45}),
      scan({0.35, 0.25}),
  };
  const BaselineMaps maps(row(), scans);
  const std::vector<Voxel> map = maps.make(BaselineMap::per_ray);
  EXPECT_NEAR(map[0].probability, 0.12, 1e-6);
  const double two_below_clamp = 0.97 / 0.03 * 4.0 / 9.0;
  EXPECT_NEAR(map[2].probability, from_odds(std::min(0.97 / 0.03, two_below_clamp * 2.0 / 3.0 * 7.0 / 3.0)), 1e-6);
  EXPECT_NEAR(map[3].probability, hits_and_misses(2, 1), 1e-6);
  EXPECT_NEAR(maps.make(BaselineMap::octomap)[2].probability, hits_and_misses(2, 0), 1e-6);
}

TEST(BaselineMaps, HitRatioIsTheShareOfRaysThatEnded) {
  const std::vector<Scan> scans = {scan({0.45, 0.43, 0.55}, {0.25}), scan({0.25, 9.0, 0.95}), scan({0.45})};
  const BaselineMaps maps(row(), scans);
  expect_near(maps.make(BaselineMap::hit_ratio),
              {0.05 / 8.1, 0.05 / 8.1, 1.05 / 7.1, 0.05 / 6.1, 3.05 / 6.1, 1.05 / 3.1, 0.05 / 2.1, 0.05 / 2.1});
  EXPECT_DOUBLE_EQ(hit_ratio({}), 0.5);
}

TEST(BaselineMaps, BetaBinomialMapIsMadeOfTheRaysCounts) {
  const std::vector<Scan> scans = {scan({0.45, 0.43, 0.55}, {0.25}), scan({0.25, 9.0, 0.95}), scan({0.45})};
  std::vector<double> expected;  // the posterior itself is tested beside this file
  for (const auto& [hits, misses] :
       std::vector<std::pair<unsigned, unsigned>>{{0, 8}, {0, 8}, {1, 6}, {0, 6}, {3, 3}, {1, 2}, {0, 2}, {0, 2}})
    expected.push_back(beta_binomial({hits, misses, 0, 0}));
  expect_near(BaselineMaps(row(), scans).make(BaselineMap::beta_binomial), expected);
}

TEST(BaselineMaps, VoxelsNobodyVisitsAreUnmeasuredAndHalf) {
  const std::vector<Scan> scans = {scan({0.25})};
  for (const std::vector<Scan>& each : {scans, std::vector<Scan>{}}) {
    const BaselineMaps maps(row(), each);
    for (const BaselineMapInfo& info : baseline_maps) {
      const std::vector<Voxel> map = maps.make(info.map);
      for (std::size_t v = 0; v < 8; ++v) {
        const bool visited = !each.empty() && v < 3;
        EXPECT_EQ(map[v].measured, visited) << info.name << v;
        if (visited) continue;
        EXPECT_EQ(map[v].probability, 0.5f) << info.name;
        EXPECT_EQ(map[v].entropy, Voxel{}.entropy) << info.name;
        EXPECT_EQ(map[v].voxel_class, VoxelClass::unknown) << info.name;
      }
    }
  }
}

TEST(BaselineMaps, EntropyAndClassAreThoseOfTheProbability) {
  std::vector<Scan> scans(5, scan({0.25, 0.55}));
  InverseSensorModel model;
  model.free_below = 0.3;
  model.occupied_above = 0.6;
  const BaselineMaps maps(row(), scans, model);
  for (const BaselineMapInfo& info : baseline_maps) {
    std::set<VoxelClass> classes;
    for (const Voxel& voxel : maps.make(info.map)) {
      const double q = voxel.probability;
      const double of_free = q < 1.0 ? -(1.0 - q) * std::log1p(-q) : 0.0;  // so sure may single precision be
      EXPECT_NEAR(voxel.entropy, -q * std::log(q) + of_free, 1e-6) << info.name;
      EXPECT_EQ(voxel.voxel_class, q < 0.3   ? VoxelClass::free
                                   : q > 0.6 ? VoxelClass::occupied
                                             : VoxelClass::unknown)
          << info.name;
      classes.insert(voxel.voxel_class);
    }
    EXPECT_EQ(classes.size(), 3u) << info.name;
  }
}

TEST(BaselineMaps, TheTermsAreTheModels) {
  InverseSensorModel model;
  model.hit = 0.9;
  model.miss = 0.25;
  const std::vector<Scan> scans = {scan({0.25, 0.25})};
  const BaselineMaps maps(row(), scans, model);
  EXPECT_NEAR(maps.make(BaselineMap::octomap)[2].probability, 0.9, 1e-6);
  EXPECT_NEAR(maps.make(BaselineMap::no_clamps)[2].probability, 0.9, 1e-6);
  EXPECT_NEAR(maps.make(BaselineMap::per_ray)[2].probability, 0.97, 1e-6);
  EXPECT_NEAR(maps.make(BaselineMap::no_clamps)[1].probability, 0.25, 1e-6);
}

// Rays of all lengths, along axes, through faces, from inside and outside of the grid.
TEST(BaselineMaps, CountsAreOfTheRaysAsTheOccupancyMapTakesThem) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.6, 0.02);
  std::mt19937 random(3);
  std::vector<Scan> scans;
  for (const Vector3& origin : random_scans::origins()) {
    scans.push_back(random_scans::scan(random, origin, grid.resolution, 400));
    random_scans::add_passes(scans.back(), random, 50);
  }
  std::vector<std::uint32_t> hits(grid.voxel_count()), misses(grid.voxel_count());
  OccupancyMap together(grid, {});
  for (const Scan& each : scans) {
    OccupancyMap alone(grid, {});
    alone.insert(each);
    together.insert(each);
    for (std::size_t v = 0; v < hits.size(); ++v) {
      hits[v] += alone.log_odds(v) > 0.0f;
      misses[v] += alone.log_odds(v) < 0.0f;
    }
  }
  const BaselineMaps maps(grid, scans);
  std::size_t visited = 0, hit = 0;
  for (std::size_t v = 0; v < hits.size(); ++v) {
    const RayCounts& c = maps.counts()[v];
    ASSERT_EQ(c.scan_hits, hits[v]) << v;
    ASSERT_EQ(c.scan_misses, misses[v]) << v;
    ASSERT_GE(c.hits, c.scan_hits);
    visited += c.any();
    hit += c.hits > 0;
  }
  EXPECT_GT(visited, 10'000u);
  EXPECT_GT(hit, 400u);
  const std::vector<Voxel> octomap = maps.make(BaselineMap::octomap), no_clamps = maps.make(BaselineMap::no_clamps);
  for (std::size_t v = 0; v < hits.size(); ++v) {
    ASSERT_EQ(octomap[v].probability, together.voxels()[v].probability);
    ASSERT_EQ(octomap[v].measured, maps.counts()[v].any());
    ASSERT_EQ(no_clamps[v].measured, maps.counts()[v].any());
  }
}

TEST(BaselineMaps, TheTableNamesEachMapOnce) {
  std::set<std::string_view> names;
  std::set<BaselineMap> maps;
  for (const BaselineMapInfo& info : baseline_maps) {
    EXPECT_FALSE(info.description.empty()) << info.name;
    names.insert(info.name);
    maps.insert(info.map);
  }
  EXPECT_EQ(names.size(), baseline_maps.size());
  EXPECT_EQ(maps.size(), baseline_maps.size());
}

TEST(BaselineMaps, BadInputIsRefused) {
  for (const double range : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<Scan> scans = {scan({0.25}), scan({0.25})};
    scans[1].max_range = range;
    EXPECT_THROW(BaselineMaps(row(), scans), std::invalid_argument) << range;
  }
  InverseSensorModel model;
  model.hit = 0.4;
  EXPECT_THROW(BaselineMaps(row(), {}, model), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

#include "core/map/voxel_history.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <optional>

#include "core/map/occupancy_map.hpp"
#include "tests/unit/map/octomap_twin.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

using Scans = std::vector<std::shared_ptr<const Scan>>;

constexpr double max_range = 1.5;
VoxelGrid region() { return region_of_interest(Vector3(0.013, -0.02, 0.04), 0.44, 0.04); }

Scans random_views(int rays, int misses) {
  std::mt19937 random(23);
  Scans scans;
  for (int round = 0; round < 2; ++round)
    for (const Vector3& origin : random_scans::origins()) {
      Scan scan = random_scans::scan(random, origin, 0.04, rays, max_range);
      random_scans::add_passes(scan, random, misses);
      scans.push_back(std::make_shared<Scan>(std::move(scan)));
    }
  return scans;
}

std::vector<InverseSensorModel> models() {
  InverseSensorModel bold, fading, rising;
  bold.hit = 0.95, bold.miss = 0.1;  // meets the clamps soon
  fading.hit_decay = 1.0, fading.miss_decay = 0.4;
  rising.hit_decay = -5.0, rising.miss_decay = 5.0;
  return {{}, bold, fading, rising};
}

// After each scan, of each voxel, the bits of a map that was made either way.
TEST(VoxelHistory, EndsWhereBothInsertionsOfTheMapEnd) {
  const Scans scans = random_views(300, 100);
  const VoxelGrid grid = region();
  for (const InverseSensorModel& model : models()) {
    std::vector<std::vector<VoxelUpdate>> histories;
    for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) histories.push_back(voxel_history(grid, model, scans, v));
    OccupancyMap direct(grid, model), registered(grid, model);
    std::size_t measured = 0;
    for (std::size_t k = 0; k < scans.size(); ++k) {
      direct.insert(*scans[k]);
      OccupancyMap local(grid, model);
      local.insert(*scans[k]);
      registered.register_local(local, scans[k]->origin);
      for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
        const VoxelUpdate& update = histories[v][k];
        for (const OccupancyMap* map : {&direct, &registered}) {
          ASSERT_EQ(update.log_odds, map->log_odds(v)) << "voxel " << v << " scan " << k;
          ASSERT_EQ(update.probability, map->voxels()[v].probability);
        }
        ASSERT_EQ(update.measured(), local.voxels()[v].measured);
        const float before = k == 0 ? 0.0f : histories[v][k - 1].log_odds;
        ASSERT_EQ(update.log_odds_change, update.log_odds - before);
        measured += update.measured();
      }
    }
    EXPECT_GT(measured, 2000u);
  }
}

// OctoMap's own rays, counted one by one.
TEST(VoxelHistory, CountsTheRaysThatOctoMapCasts) {
  const VoxelGrid grid = region();
  const octomap::OcTree tree(grid.resolution);
  const Scans scans = random_views(300, 100);
  std::size_t all_hits = 0, all_passes = 0;
  for (const auto& scan : scans) {
    std::vector<std::size_t> hits(grid.voxel_count()), misses(grid.voxel_count());
    const octomap::point3d origin = octomap_twin::to_octomap(scan->origin.cast<float>());
    const auto voxel = [&](const octomap::OcTreeKey& key) -> std::optional<std::uint32_t> {
      const int zero = 1 << (tree.getTreeDepth() - 1);
      const Eigen::Vector3i cell = Eigen::Vector3i(key[0] - zero, key[1] - zero, key[2] - zero) - grid.first;
      return grid.contains(cell) ? std::optional(grid.index(cell)) : std::nullopt;
    };
    octomap::KeyRay keys;
    const auto count = [&](const Eigen::Vector3f& point, bool is_return) {
      octomap::point3d end = octomap_twin::to_octomap(point);
      const bool in_range = (end - origin).norm() <= max_range;
      if (!in_range) end = origin + (end - origin).normalized() * float(max_range);
      tree.computeRayKeys(origin, end, keys);
      for (const auto& key : keys)
        if (const auto v = voxel(key)) ++misses[*v];
      if (const auto v = voxel(tree.coordToKey(end)); v && is_return && in_range) ++hits[*v];
    };
    for (const auto& p : scan->hits) count(p, true);
    for (const auto& p : scan->misses) count(p, false);
    for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
      const auto history = voxel_history(grid, {}, std::array{scan}, v);
      ASSERT_EQ(history[0].hits, hits[v]) << v;
      ASSERT_EQ(history[0].misses, misses[v]) << v;
      all_hits += hits[v], all_passes += misses[v];
    }
  }
  EXPECT_GT(all_hits, 1000u);
  EXPECT_GT(all_passes, 10'000u);
}

TEST(VoxelHistory, TellsAStory) {
  VoxelGrid row;
  row.resolution = 0.1;
  row.size = {8, 1, 1};
  const Vector3 camera(-0.35, 0.05, 0.05);
  const auto scan = [&](PointCloud hits, PointCloud misses = {}) {
    return std::make_shared<const Scan>(Scan{camera, std::move(hits), std::move(misses), max_range});
  };
  const Eigen::Vector3f in_4(0.42f, 0.05f, 0.05f), in_6(0.62f, 0.05f, 0.05f), far(1.15f, 0.05f, 0.05f);
  const Eigen::Vector3f too_far(2.0f, 0.05f, 0.05f), away(-1.85f, 0.05f, 0.05f);
  const Scans scans = {scan({in_4, in_4, in_6}), scan({away}), scan({in_6, too_far}, {far, away}), scan({in_4})};
  const auto history = voxel_history(row, {}, scans, 4);
  ASSERT_EQ(history.size(), 4u);
  EXPECT_EQ(history[0].hits, 2u);
  EXPECT_EQ(history[0].misses, 1u);
  EXPECT_FLOAT_EQ(history[0].log_odds_change, float(log_odds(0.7))) << "once a scan, and a hit wins";
  EXPECT_FALSE(history[1].measured());
  EXPECT_EQ(history[1].log_odds_change, 0.0f);
  EXPECT_FLOAT_EQ(history[1].probability, 0.7f);
  EXPECT_EQ(history[2].hits, 0u);
  EXPECT_EQ(history[2].misses, 3u) << "a return in front of its end, one out of range, a pass";
  EXPECT_FLOAT_EQ(history[2].log_odds_change, float(log_odds(0.4)));
  EXPECT_NEAR(history[3].log_odds, 2 * log_odds(0.7) + log_odds(0.4), 1e-6);

  const auto rays = rays_through(row, *scans[2], 4);
  ASSERT_EQ(rays.size(), 3u);
  EXPECT_EQ(rays[0].end, in_6);
  EXPECT_TRUE(rays[0].met_surface && !rays[0].hit);
  EXPECT_NEAR(rays[1].end.x(), -0.35 + max_range, 1e-6) << "cut at the maximum range";
  EXPECT_FALSE(rays[1].met_surface || rays[1].hit);
  EXPECT_EQ(rays[2].end, far);
  EXPECT_FALSE(rays[2].met_surface || rays[2].hit);
  EXPECT_TRUE(rays_through(row, *scans[0], 4)[0].hit);
  EXPECT_TRUE(voxel_history(row, {}, {}, 4).empty());
}

TEST(VoxelHistory, TheSameOnOneThreadAndTwo) {
  const Scans scans = random_views(300, 100);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return voxel_history(region(), {}, scans, 700);
  };
  const auto one = run(1), two = run(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].hits, two[k].hits);
    EXPECT_EQ(one[k].misses, two[k].misses);
    EXPECT_EQ(one[k].log_odds, two[k].log_odds);
  }
}

}  // namespace
}  // namespace nextview

// Rays of any length, to the end of the world and beyond: what they do in the grid, and that they end.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "core/map/occupancy_map.hpp"
#include "core/map/traversal.hpp"

namespace nextview {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
using Cells = std::vector<Eigen::Vector3i>;

TEST(LongSegments, InsideTheGridTheSameVoxelsAreVisited) {
  const VoxelGrid grid = region_of_interest(Vector3(0.1, 0.0, -0.05), 0.5, 0.02);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> near(-0.6f, 0.6f);
  std::size_t visits = 0;
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector3f origin(near(random), near(random), near(random)), end(near(random), near(random), near(random));
    if (i % 3 == 0) end[i % 9 / 3] = origin[i % 9 / 3];  // along a plane of voxels
    Cells all, inside;
    walk_segment(grid, origin, end, [&](int x, int y, int z) {
      if (grid.contains({x, y, z})) all.emplace_back(x, y, z);
      return true;
    });
    walk_segment_inside(grid, origin, end, [&](int x, int y, int z) {
      inside.emplace_back(x, y, z);
      return true;
    });
    EXPECT_EQ(all, inside) << origin.transpose() << " to " << end.transpose();
    visits += inside.size();
  }
  EXPECT_GT(visits, 5000u);
}

// What a single precision number cannot hold has no direction, and used to be walked two billion voxels far.
TEST(LongSegments, WithoutAnEndAreNotWalked) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.0, 0.01);
  for (const Eigen::Vector3f& end :
       {Eigen::Vector3f(infinity, 0, 0), Eigen::Vector3f(0, -infinity, 0), Eigen::Vector3f(1e38f, 1e38f, 0),
        Eigen::Vector3f(0, 0, std::numeric_limits<float>::quiet_NaN())}) {
    int visits = 0;
    walk_segment(grid, Eigen::Vector3f::Zero(), end, [&](int, int, int) { return ++visits < 1000; });
    EXPECT_EQ(visits, 0) << end.transpose();
  }
}

/// A map that has a scan of this point alone.
OccupancyMap map_of(const Eigen::Vector3f& point, double max_range) {
  OccupancyMap map(region_of_interest(Vector3::Zero(), 1.0, 0.01), {});
  map.insert({Vector3(0.005, 0.005, 0.005), {point}, {}, max_range});
  return map;
}

TEST(LongSegments, CarveTheGridLikeShortOnes) {
  const auto carved = [](const OccupancyMap& map) {
    Cells cells;
    for (std::uint32_t v = 0; v < map.voxels().size(); ++v)
      if (map.voxels()[v].measured) cells.push_back(map.grid().cell(v));
    return cells;
  };
  const Cells expected = carved(map_of({3.0f, 0.005f, 0.005f}, 2.0));
  EXPECT_EQ(expected.size(), 50u);
  for (const float far : {1e3f, 1e9f, 1e15f}) {
    EXPECT_EQ(carved(map_of({far, 0.005f, 0.005f}, 2.0)), expected) << far;
    EXPECT_EQ(carved(map_of({far, 0.005f, 0.005f}, 1e18)), expected) << far << ", which is within range";
  }
  EXPECT_TRUE(carved(map_of({infinity, 0.0f, 0.0f}, 2.0)).empty());
}

}  // namespace
}  // namespace nextview

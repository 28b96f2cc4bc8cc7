#include "core/evaluation/visited_voxels.hpp"

#include <gtest/gtest.h>

#include "core/progress/stopped.hpp"
#include "tests/unit/map/random_scans.hpp"
#include "tests/unit/map/slab_test.hpp"

namespace nextview {
namespace {

/// Of another length along each axis, and not around the origin.
const VoxelGrid grid{0.05, {-3, 2, -9}, {11, 5, 8}};

/// Rays from outside to places in and behind the grid.
Scan random_scan(std::mt19937& random) {
  Scan scan;
  const Vector3 centre = 0.5 * (grid.lower() + grid.upper());
  scan.origin = centre + 1.0 * random_scans::direction(random);
  scan.max_range = 0.1;  // is none of a noise-free scan's rays
  for (int i = 0; i < 12; ++i) {
    const Vector3 end = centre + random_scans::point_in_box(random, 0.2);
    scan.hits.push_back(end.cast<float>());
    const Vector3 behind = 2.0 * (centre + random_scans::point_in_box(random, 0.2)) - scan.origin;
    scan.misses.push_back(behind.cast<float>());
  }
  return scan;
}

/// How far the longest of a scan's rays goes through a voxel, by the slab test [m]; less than 0 where none meets it.
double longest_way(const Scan& scan, std::uint32_t voxel) {
  double longest = -1.0;
  for (const PointCloud* ends : {&scan.hits, &scan.misses})
    for (const Eigen::Vector3f& end : *ends) {
      const Vector3 ray = end.cast<double>() - scan.origin;
      const auto part = slab_test::overlap(grid, voxel, 0.0, scan.origin, ray.normalized(), ray.norm());
      longest = std::max(longest, part.length());
    }
  return longest;
}

TEST(VisitedVoxels, AreThoseThatRaysGoThrough) {
  std::mt19937 random(5);
  constexpr double rounding = 1e-5;  // of single precision, half a metre off [m]
  std::size_t visits = 0;
  for (int n = 0; n < 20; ++n) {
    const Scan scan = random_scan(random);
    BitMask visited(grid.voxel_count());
    mark_visited(grid, scan, visited);
    for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
      const double way = longest_way(scan, v);
      if (std::abs(way) > rounding) {
        ASSERT_EQ(visited[v], way > 0.0) << n << ", " << grid.cell(v).transpose();
      }
      visits += visited[v];
    }
  }
  EXPECT_GT(visits, 1000u);
  EXPECT_LT(visits, 15 * grid.voxel_count()) << "not all of them each time";
}

TEST(VisitedVoxels, EndsBelongToThem) {
  for (const bool hit : {true, false}) {
    Scan scan;
    scan.origin = grid.centre(grid.index({0, 2, 3})) - Vector3(1, 0, 0);
    const Vector3 end = grid.centre(grid.index({6, 2, 3}));
    (hit ? scan.hits : scan.misses).push_back(end.cast<float>());
    BitMask visited(grid.voxel_count());
    mark_visited(grid, scan, visited);
    for (int x = 0; x < grid.size.x(); ++x) EXPECT_EQ(visited[grid.index({x, 2, 3})], x <= 6) << x;
    EXPECT_EQ(std::ranges::count(visited.bytes(), 1), 7);
  }
}

TEST(VisitedVoxels, AreAddedToThoseThatWereVisitedBefore) {
  std::mt19937 random(6);
  const Scan first = random_scan(random), second = random_scan(random);
  BitMask of_first(grid.voxel_count()), of_second(grid.voxel_count()), both(grid.voxel_count());
  mark_visited(grid, first, of_first);
  mark_visited(grid, second, of_second);
  mark_visited(grid, first, both);
  mark_visited(grid, second, both);
  for (std::size_t v = 0; v < both.size(); ++v) ASSERT_EQ(both[v], of_first[v] || of_second[v]) << v;
  EXPECT_NE(of_first, of_second);
}

TEST(VisitedVoxels, AStopSetsNone) {
  std::mt19937 random(7);
  std::stop_source stop;
  stop.request_stop();
  BitMask visited(grid.voxel_count());
  EXPECT_THROW(mark_visited(grid, random_scan(random), visited, stop.get_token()), Stopped);
  EXPECT_EQ(visited, BitMask(grid.voxel_count()));
}

}  // namespace
}  // namespace nextview

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/map/traversal.hpp"
#include "tests/unit/map/random_scans.hpp"
#include "tests/unit/map/slab_test.hpp"

namespace nextview {
namespace {

const VoxelGrid grid{0.05, {-7, -3, -5}, {13, 9, 11}};

std::vector<std::uint32_t> walked(const Vector3& origin, const Vector3& direction, double max_range) {
  std::vector<std::uint32_t> voxels;
  walk_ray(grid, origin, direction, max_range, [&](int x, int y, int z) {
    EXPECT_TRUE(grid.contains({x, y, z}));
    voxels.push_back(grid.index({x, y, z}));
    return true;
  });
  return voxels;
}

/// Every voxel of the grid is put to the slab test, made `margin` smaller and larger: within it rounding decides.
void expect_agreement(const Vector3& origin, const Vector3& direction, double max_range) {
  constexpr double margin = 1e-8;
  const std::vector<std::uint32_t> voxels = walked(origin, direction, max_range);
  std::vector<std::uint8_t> visits(grid.voxel_count());
  for (const std::uint32_t v : voxels) ++visits[v];
  double entered = -1.0;
  for (const std::uint32_t v : voxels) {
    const auto at = slab_test::overlap(grid, v, margin, origin, direction, max_range + margin);
    ASSERT_LT(at.enter, at.leave) << "voxel " << v << " is not on the ray";
    ASSERT_GE(at.enter, entered - 1e-6) << "out of order";
    entered = at.enter;
  }
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
    ASSERT_LE(int(visits[v]), 1);
    const auto at = slab_test::overlap(grid, v, -margin, origin, direction, max_range - margin);
    if (at.length() > 0.0) {
      ASSERT_EQ(int(visits[v]), 1) << "voxel " << v << " was missed";
    }
  }
}

TEST(WalkRay, RandomRaysFromOutsideAndInside) {
  std::mt19937 random(1);
  std::size_t visits = 0, misses = 0;
  for (int n = 0; n < 3000; ++n) {
    const Vector3 origin = random_scans::point_in_box(random, n % 2 ? 0.25 : 1.5);
    const Vector3 towards =
        n % 3 ? Vector3(random_scans::point_in_box(random, 0.3) - origin) : random_scans::point_in_box(random, 1);
    expect_agreement(origin, towards.normalized(), 4.0);
    const std::size_t count = walked(origin, towards.normalized(), 4.0).size();
    visits += count;
    misses += count == 0;
  }
  EXPECT_GT(visits, 20'000u);
  EXPECT_GT(misses, 200u);
}

TEST(WalkRay, TheMaximumRangeCuts) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> range(0.0, 1.5);
  for (int n = 0; n < 2000; ++n) {
    const Vector3 origin = random_scans::point_in_box(random, 0.9);
    expect_agreement(origin, (random_scans::point_in_box(random, 0.3) - origin).normalized(), range(random));
  }
}

TEST(WalkRay, ParallelToAxesAndPlanes) {
  std::mt19937 random(3);
  for (int n = 0; n < 2000; ++n) {
    const Vector3 origin = random_scans::point_in_box(random, n % 2 ? 0.25 : 1.0);
    Vector3 direction = random_scans::direction(random);
    direction[n % 3] = 0.0;
    if (n % 4 == 0) direction[(n + 1) % 3] = 0.0;
    expect_agreement(origin, direction.normalized(), 3.0);
  }
}

TEST(WalkRay, NearlyParallelToAxes) {
  std::mt19937 random(4);
  for (const double tilt : {1e-3, 1e-6, 1e-9, 1e-12, 1e-16, 1e-300, 5e-324})
    for (int n = 0; n < 200; ++n) {
      Vector3 direction(tilt, -tilt, 0);
      direction[n % 3] = n % 2 ? 1.0 : -1.0;
      expect_agreement(random_scans::point_in_box(random, 0.9), direction, 3.0);
    }
}

// A voxel spans [n, n+1): of a ray in the plane between two voxels the upper one is visited.
TEST(WalkRay, InThePlaneBetweenVoxelsVisitsTheUpperOne) {
  const VoxelGrid dyadic{0.0625, {-4, -4, -4}, {8, 8, 8}};  // planes at exact numbers
  for (int plane = -4; plane <= 4; ++plane) {
    std::vector<Eigen::Vector3i> cells;
    walk_ray(dyadic, Vector3(-1, plane * 0.0625, 0.01), Vector3::UnitX(), 3.0, [&](int x, int y, int z) {
      cells.push_back({x, y, z});
      return true;
    });
    ASSERT_EQ(cells.size(), plane == 4 ? 0u : 8u) << plane;
    for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i], Eigen::Vector3i(int(i), plane + 4, 4));
  }
}

// Through edges and corners any order is right, but no voxel may come twice, none lie off the ray, and no step be long.
TEST(WalkRay, ThroughCornersStaysConnectedAndOnTheRay) {
  for (const Vector3& towards :
       {Vector3(1, 1, 1), Vector3(1, 1, 0), Vector3(-1, 1, -1), Vector3(2, 1, 0), Vector3(0, -1, 1)})
    for (const Vector3& through : {Vector3(0, 0, 0), Vector3(0.05, 0.05, -0.05), Vector3(0.025, 0.025, 0.025)}) {
      const Vector3 direction = towards.normalized(), origin = through - 2.0 * direction;
      expect_agreement(origin, direction, 5.0);
      const std::vector<std::uint32_t> voxels = walked(origin, direction, 5.0);
      EXPECT_GE(voxels.size(), 5u);
      for (std::size_t i = 1; i < voxels.size(); ++i)
        EXPECT_EQ((grid.cell(voxels[i]) - grid.cell(voxels[i - 1])).cwiseAbs().sum(), 1);
    }
}

TEST(WalkRay, StopsWhenTold) {
  int visits = 0;
  walk_ray(grid, Vector3(-1, 0.01, 0.01), Vector3::UnitX(), 3.0, [&](int, int, int) { return ++visits < 4; });
  EXPECT_EQ(visits, 4);
}

TEST(WalkRay, VisitsNothingOfAnEmptyGridOrWithoutRange) {
  EXPECT_TRUE(walked(Vector3(-1, 0, 0), Vector3::UnitX(), 0.0).empty());
  walk_ray(VoxelGrid{}, Vector3(-1, 0, 0), Vector3::UnitX(), 3.0, [](int, int, int) {
    ADD_FAILURE();
    return false;
  });
}

}  // namespace
}  // namespace nextview

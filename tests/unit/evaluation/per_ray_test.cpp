#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/evaluation/baseline_maps.hpp"
#include "tests/unit/map/random_scans.hpp"

// The per-ray map and the counts against a brute force: every ray against every voxel's box, no walk from voxel to
// voxel.
namespace nextview {
namespace {

constexpr double longest_ray = 1.5;  // [m]
constexpr double doubt = 1e-5;       // chords shorter than this may round to either side [m]

/// Length of the ray's way through the voxel between its origin and `length` [m]; negative if it misses the voxel.
double chord(const VoxelGrid& grid, std::uint32_t voxel, const Vector3& origin, const Vector3& direction,
             double length) {
  double enter = 0.0, leave = length;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = grid.centre(voxel)[axis] - 0.5 * grid.resolution, upper = lower + grid.resolution;
    const double a = (lower - origin[axis]) / direction[axis], b = (upper - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return leave - enter;
}

struct BruteForce {
  RayCounts counts;
  double odds = 1.0;
  bool doubtful = false;  ///< rounding decides about one of the rays
};

void take(BruteForce& voxel, const VoxelGrid& grid, std::uint32_t index, const Vector3& origin, const Vector3& point,
          bool is_return) {
  const double length = (point - origin).norm();
  const bool in_range = length <= longest_ray;
  const double walked = std::min(length, longest_ray);
  const Vector3 direction = (point - origin) / length, end = origin + walked * direction;
  const Vector3 from_centre = (end - grid.centre(index)).cwiseAbs();
  const double outside = from_centre.maxCoeff() - 0.5 * grid.resolution;  // of the end, negative: in the voxel
  const double way = chord(grid, index, origin, direction, walked);
  voxel.doubtful |= std::abs(outside) < doubt || std::abs(way) < doubt || std::abs(length - longest_ray) < doubt;
  double factor = 1.0;
  if (outside < 0.0) {
    if (!is_return || !in_range) return;  // the voxel of a way's end is not carved
    ++voxel.counts.hits;
    factor = 7.0 / 3.0;
  } else if (way > 0.0) {
    ++voxel.counts.misses;
    factor = 2.0 / 3.0;
  }
  if (factor != 1.0) voxel.odds = std::clamp(voxel.odds * factor, 0.12 / 0.88, 0.97 / 0.03);
}

TEST(PerRayMap, AgreesWithABruteForceOverAllRaysAndVoxels) {
  const VoxelGrid grid = region_of_interest({0.003, -0.002, 0.004}, 0.48, 0.04);
  std::mt19937 random(11);
  std::vector<Scan> scans;
  for (const Vector3& origin : {Vector3(0.9, 0.1, 0.2), Vector3(-0.61, 0.53, -0.4), Vector3(0.05, 0.033, 0.131)}) {
    Scan scan{origin.cast<float>().cast<double>(), {}, {}, 1.499};
    for (int n = 0; n < 300; ++n) {  // of a sphere, and on beyond the range
      const double reach = n % 10 == 0 ? 2.0 : 0.2;
      scan.hits.push_back((reach * random_scans::direction(random)).cast<float>());
    }
    random_scans::add_passes(scan, random, 100);
    scan.max_range = longest_ray;  // passes end within it, clear of its rounding
    scans.push_back(scan);
  }

  const BaselineMaps maps(grid, scans);
  const std::vector<Voxel> per_ray = maps.make(BaselineMap::per_ray);
  std::size_t compared = 0, hit = 0, at_clamps = 0;
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
    BruteForce expected;
    for (const Scan& scan : scans)
      for (const auto* ends : {&scan.hits, &scan.misses})
        for (const auto& end : *ends) take(expected, grid, v, scan.origin, end.cast<double>(), ends == &scan.hits);
    if (expected.doubtful) continue;
    ++compared;
    ASSERT_EQ(maps.counts()[v].hits, expected.counts.hits) << v;
    ASSERT_EQ(maps.counts()[v].misses, expected.counts.misses) << v;
    ASSERT_NEAR(per_ray[v].probability, expected.odds / (1.0 + expected.odds), 1e-6) << v;
    ASSERT_EQ(per_ray[v].measured, expected.counts.any());
    hit += expected.counts.hits > 0;
    at_clamps += std::abs(per_ray[v].probability - 0.12) < 1e-6 || std::abs(per_ray[v].probability - 0.97) < 1e-6;
  }
  EXPECT_GT(compared, 9 * grid.voxel_count() / 10);
  EXPECT_GT(hit, 100u);
  EXPECT_GT(at_clamps, 100u);
}

}  // namespace
}  // namespace nextview

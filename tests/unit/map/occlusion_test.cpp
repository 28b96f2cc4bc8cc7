#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/map/occupancy_map.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

constexpr double voxel_edge = 0.02, margin = 1e-5;

/// The voxels behind a return up to `distance`, on the lattice, without the return's own and the one of the end: sorts
/// where the line meets any plane of the lattice and looks where the middles between lie. Nothing if rounding could
/// decide (two planes at once, or an end on a plane).
std::optional<std::vector<Eigen::Vector3i>> voxels_behind(const Vector3& from, const Vector3& direction,
                                                          double distance) {
  std::vector<double> crossings = {0.0, distance};
  for (int k = 0; k < 3; ++k)
    for (double plane = std::ceil((from[k] - distance) / voxel_edge); plane * voxel_edge <= from[k] + distance;
         ++plane) {
      const double t = (plane * voxel_edge - from[k]) / direction[k];
      if (t > -margin && t < distance + margin) crossings.push_back(t);
    }
  std::sort(crossings.begin(), crossings.end());
  std::vector<Eigen::Vector3i> voxels;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    if (crossings[i] - crossings[i - 1] < margin) return std::nullopt;
    const Vector3 middle = from + 0.5 * (crossings[i - 1] + crossings[i]) * direction;
    voxels.push_back((middle / voxel_edge).array().floor().cast<int>());
  }
  if (voxels.size() < 2) return std::vector<Eigen::Vector3i>();
  return std::vector<Eigen::Vector3i>(voxels.begin() + 1, voxels.end() - 1);
}

/// Scans whose hits all lead to clear cases, with the smallest step count of each unmeasured voxel.
struct Twin {
  explicit Twin(const VoxelGrid& region) : grid(region), steps(region.voxel_count()) {}

  void add(const OccupancyMap& map, const Scan& scan, double distance) {
    for (const auto& p : scan.hits) {
      const Vector3 ray = p.cast<double>() - scan.origin;
      // Surfaces outside of the region are not in the map: nothing lies behind them.
      const bool in_region = grid.contains(grid.cell_at(p.cast<double>()));
      if (ray.norm() > scan.max_range || !in_region) continue;
      const auto behind = voxels_behind(p.cast<double>(), ray.normalized(), distance);
      for (std::size_t k = 0; k < behind->size(); ++k) {
        const Eigen::Vector3i cell = (*behind)[k] - grid.first;
        if (!grid.contains(cell) || map.voxels()[grid.index(cell)].measured) continue;
        std::size_t& old = steps[grid.index(cell)];
        old = old == 0 ? k + 1 : std::min(old, k + 1);
      }
    }
  }
  VoxelGrid grid;
  std::vector<std::size_t> steps;
};

Scan clear_scan(std::mt19937& random, const Vector3& origin, double distance, int count) {
  Scan scan = random_scans::scan(random, origin, voxel_edge, count);
  std::erase_if(scan.hits, [&](const Eigen::Vector3f& p) {
    const Vector3 ray = p.cast<double>() - scan.origin;
    return (ray.array().abs() < 1e-3).any() || std::abs(ray.norm() - 1.5) < margin ||
           !voxels_behind(p.cast<double>(), ray.normalized(), distance);
  });
  return scan;
}

TEST(MarkOcclusions, AgreesWithSortedPlaneCrossings) {
  std::mt19937 random(5);
  for (const double distance : {0.3, 0.1, 0.021}) {
    const VoxelGrid grid = region_of_interest(Vector3(0.02, 0.01, 0), 0.64, voxel_edge);
    OccupancyMap map(grid, {});
    Twin twin(grid);
    for (const Vector3& origin : random_scans::origins()) {
      const Scan scan = clear_scan(random, origin.cast<float>().cast<double>(), distance, 150);
      ASSERT_GT(scan.hits.size(), 60u);
      map.insert(scan);
      map.mark_occlusions(scan, distance);
      twin.add(map, scan, distance);
    }
    std::size_t marked = 0, different = 0;
    for (std::uint32_t i = 0; i < grid.voxel_count(); ++i) {
      const Voxel& v = map.voxels()[i];
      if (v.measured) continue;
      marked += v.occlusion_distance > 0;
      different += v.occlusion_distance != twin.steps[i];
    }
    EXPECT_EQ(different, 0u) << distance;
    EXPECT_GT(marked, distance > 0.2 ? 1000u : 5u);
  }
}

TEST(MarkOcclusions, CountsStepsBehindTheSurface) {
  OccupancyMap map(region_of_interest(Vector3::Zero(), 0.64, voxel_edge), {});
  const Scan scan{Vector3(-0.25, 0.01, 0.01), {{-0.05f, 0.01f, 0.01f}}, {}, 1.5};
  map.insert(scan);
  map.mark_occlusions(scan, 0.1);
  const auto distance_at = [&](double x) {
    return int(map.voxels()[map.grid().index(map.grid().cell_at(Vector3(x, 0.01, 0.01)))].occlusion_distance);
  };
  EXPECT_EQ(distance_at(-0.07), 0);  // in front
  EXPECT_EQ(distance_at(-0.05), 0);  // the return's own
  EXPECT_EQ(distance_at(-0.03), 1);
  EXPECT_EQ(distance_at(-0.01), 2);
  EXPECT_EQ(distance_at(0.03), 4);
  EXPECT_EQ(distance_at(0.07), 0);  // more than 0.1 m behind
}

TEST(MarkOcclusions, ChangesNeitherProbabilitiesNorWhatIsMeasured) {
  std::mt19937 random(6);
  OccupancyMap map(region_of_interest(Vector3::Zero(), 0.64, voxel_edge), {});
  const Scan scan = random_scans::scan(random, Vector3(0.8, 0.2, 0.1), voxel_edge, 1000);
  map.insert(scan);
  const OccupancyMap before = map;
  map.mark_occlusions(scan, 0.3);
  for (std::size_t i = 0; i < map.voxels().size(); ++i) {
    ASSERT_EQ(map.log_odds(i), before.log_odds(i));
    ASSERT_EQ(map.voxels()[i].measured, before.voxels()[i].measured);
    ASSERT_EQ(map.voxels()[i].probability, before.voxels()[i].probability);
  }
}

TEST(MarkOcclusions, HitsOutOfRangeMarkNothing) {
  OccupancyMap map(region_of_interest(Vector3::Zero(), 0.64, voxel_edge), {});
  Scan scan{Vector3(-0.25, 0.01, 0.01), {{0.05f, 0.01f, 0.01f}}, {{0.09f, 0.03f, 0.01f}}, 0.2};
  map.mark_occlusions(scan, 0.3);
  for (const Voxel& v : map.voxels()) ASSERT_EQ(v.occlusion_distance, 0);
  scan.max_range = 0.31;
  map.mark_occlusions(scan, 0.3);
  EXPECT_GT(std::ranges::count_if(map.voxels(), [](const Voxel& v) { return v.occlusion_distance > 0; }), 5)
      << "the same in range";
}

TEST(MarkOcclusions, LongDistancesDoNotWrapAround) {
  OccupancyMap map(VoxelGrid{0.005, {-320, 0, 0}, {640, 2, 2}}, {});
  const Scan scan{Vector3(-1.5, 0.0025, 0.0025), {{-1.4f, 0.0025f, 0.0025f}}, {}, 1.5};
  map.insert(scan);
  map.mark_occlusions(scan, 2.5);
  int last = 0;
  for (double x = -1.39; x < 1.0; x += 0.005) {
    const Voxel& v = map.voxels()[map.grid().index(map.grid().cell_at(Vector3(x, 0.0025, 0.0025)))];
    ASSERT_GE(int(v.occlusion_distance), last) << x;
    last = v.occlusion_distance;
  }
  EXPECT_GT(last, 255);
}

}  // namespace
}  // namespace nextview

#include "core/gain/occupied_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/gain/evidence_maps.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;

/// How far along each direction.
std::array<int, 9> along(const Vector3i& c) {
  return {c.x(),         c.y(),         c.z(),         c.x() + c.y(), c.x() - c.y(),
          c.x() + c.z(), c.x() - c.z(), c.y() + c.z(), c.y() - c.z()};
}

TEST(OccupiedHull, IsBetweenTheOutliersAtBothEnds) {
  std::mt19937 random(8);
  for (const Vector3i& size : {Vector3i(20, 30, 13), Vector3i(9, 8, 40), Vector3i(64, 24, 24)})
    for (const double occupied : {0.01, 0.4}) {
      const auto made = evidence_maps::random_map(random, size, occupied, 0.3);
      std::array<std::vector<int>, 9> sorted;
      evidence_maps::MadeMap::for_each(Vector3i::Zero(), size - Vector3i::Ones(), [&](const Vector3i& cell) {
        const Voxel voxel = made.map.voxels().at(cell.x(), cell.y(), cell.z());
        if (!voxel.measured || voxel.probability < 0.5f) return;
        for (std::size_t d = 0; d < 9; ++d) sorted[d].push_back(along(cell)[d]);
      });
      const OccupiedHull hull = occupied_hull(made.map.voxels(), 0.5).value();
      const std::size_t count = sorted[0].size(), outliers = count / 1000;
      for (std::size_t d = 0; d < 9; ++d) {
        std::ranges::sort(sorted[d]);
        EXPECT_EQ(hull.lowest[d], sorted[d][outliers]) << d << " of " << count;
        EXPECT_EQ(hull.highest[d], sorted[d][count - 1 - outliers]) << d << " of " << count;
      }
    }
}

TEST(OccupiedHull, OfNothingIsNone) {
  const evidence_maps::MadeMap made({10, 10, 10});
  EXPECT_FALSE(occupied_hull(made.map.voxels(), 0.5));
}

}  // namespace
}  // namespace nextview

#include "core/planner/open_border.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

/// A plate of 0.2 m at z = 0 that was scanned down to its edges, in a map of voxels of 1 cm that knows nothing yet.
Knowledge scanned_plate() {
  VoxelGrid grid;
  grid.resolution = 0.01;
  grid.size = Eigen::Vector3i::Constant(40);
  grid.first = Eigen::Vector3i::Constant(-20);
  Knowledge known{OccupancyMap(grid)};
  Scan scan;
  for (float x = -0.1f; x < 0.1f; x += 0.001f)
    for (float y = -0.1f; y < 0.1f; y += 0.001f) scan.hits.emplace_back(x, y, 0.001f);
  auto scanned = std::make_shared<ScannedSurface>(0.005);
  scanned->add(scan, Vector3::UnitZ(), 1e-6);
  known.scanned = std::move(scanned);
  return known;
}

/// All voxels where `where(centre)`.
template <class Where>
void measure(Knowledge& known, float log_odds, Where where) {
  const VoxelGrid& grid = known.map.grid();
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v)
    if (where(grid.centre(v))) known.map.set_log_odds(v, log_odds);
}

TEST(OpenBorder, GoesOnIntoWhatNobodyMeasured) {
  const Knowledge known = scanned_plate();
  const OpenBorder border = open_border(known);
  EXPECT_NEAR(border.length, 4 * 0.2, 0.05);
  for (const Eigen::Vector3f& at : border.beyond) {
    EXPECT_GT(at.head<2>().cwiseAbs().maxCoeff(), 0.1f) << "past the edge";
    EXPECT_LT(at.head<2>().cwiseAbs().maxCoeff(), 0.112f) << "by a voxel";
    EXPECT_NEAR(at.z(), 0.0f, 0.004f);
  }
}

TEST(OpenBorder, ASheetThatEndsInFreeSpaceIsDone) {
  Knowledge known = scanned_plate();
  measure(known, -1.0f, [](const Vector3& at) { return at.head<2>().cwiseAbs().maxCoeff() > 0.1; });
  EXPECT_EQ(open_border(known).length, 0.0);
}

TEST(OpenBorder, ASheetThatEndsWithinAVoxelIsDone) {
  Knowledge known = scanned_plate();
  measure(known, 1.0f, [](const Vector3& at) { return at.head<2>().cwiseAbs().maxCoeff() < 0.11; });
  measure(known, -1.0f, [](const Vector3& at) { return at.head<2>().cwiseAbs().maxCoeff() > 0.11; });
  EXPECT_EQ(open_border(known).length, 0.0) << "the last voxel that it touches is occupied, the next is free";
}

TEST(OpenBorder, OneSideOfFour) {
  Knowledge known = scanned_plate();
  const double all = open_border(known).length;
  measure(known, -1.0f, [](const Vector3& at) { return std::max({at.x(), at.y(), -at.y()}) > 0.1; });
  EXPECT_NEAR(open_border(known).length, all / 4.0, all / 10.0);
  measure(known, 1.0f, [](const Vector3& at) { return at.x() < -0.1; });
  EXPECT_NEAR(open_border(known).length, all / 4.0, all / 10.0) << "what is occupied may be the back of a wall";
}

TEST(OpenBorder, OfNothingIsNothing) {
  Knowledge known = scanned_plate();
  known.scanned = std::make_shared<const ScannedSurface>(0.005);
  EXPECT_EQ(open_border(known).length, 0.0);
  known.scanned = nullptr;
  EXPECT_EQ(open_border(known).length, 0.0);
}

}  // namespace
}  // namespace nextview

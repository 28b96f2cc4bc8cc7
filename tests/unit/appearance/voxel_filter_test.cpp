// Which voxels are drawn: by class, probability, entropy, and where they are.
#include "ui/appearance/voxel_filter.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

Voxel measured(VoxelClass of_class, float probability = 0.5f, float entropy = 0.0f) {
  Voxel voxel;
  voxel.voxel_class = of_class;
  voxel.probability = probability;
  voxel.entropy = entropy;
  voxel.measured = true;
  return voxel;
}

TEST(VoxelFilter, ShowsAtFirstWhatIsOccupiedAndWhatMayBe) {
  const VoxelFilter usual;
  EXPECT_TRUE(usual.shows(measured(VoxelClass::occupied, 0.9f)));
  EXPECT_TRUE(usual.shows(measured(VoxelClass::unknown, 0.7f)));
  EXPECT_TRUE(usual.shows(measured(VoxelClass::unknown, 0.5f))) << "from there on";
  EXPECT_FALSE(usual.shows(measured(VoxelClass::unknown, 0.49f))) << "a ray or two passed it";
  EXPECT_FALSE(usual.shows(measured(VoxelClass::free, 0.1f)));
  EXPECT_FALSE(usual.shows(Voxel{})) << "it is not there yet";
}

TEST(VoxelFilter, EachClassHasItsOwnSwitch) {
  for (int bits = 0; bits < 8; ++bits) {
    VoxelFilter filter;
    filter.occupied = bits & 1, filter.unknown = bits & 2, filter.free = bits & 4;
    filter.unknown_from = 0.3;
    EXPECT_EQ(filter.shows(measured(VoxelClass::occupied, 0.1f)), filter.occupied) << bits;
    EXPECT_EQ(filter.shows(measured(VoxelClass::unknown, 0.4f)), filter.unknown) << bits;
    EXPECT_FALSE(filter.shows(measured(VoxelClass::unknown, 0.2f))) << bits;
    EXPECT_EQ(filter.shows(measured(VoxelClass::free, 0.1f)), filter.free) << bits << ": the threshold is not for it";
    EXPECT_EQ(filter.shows_nothing(), bits == 0);
  }
}

TEST(VoxelFilter, WhatIsUncertainIsShownWhateverItsClass) {
  VoxelFilter filter{false, false, false};
  filter.uncertain = true;
  filter.entropy_from = 0.25;
  EXPECT_FALSE(filter.shows_nothing());
  for (const VoxelClass of_class : {VoxelClass::occupied, VoxelClass::unknown, VoxelClass::free}) {
    EXPECT_TRUE(filter.shows(measured(of_class, 0.1f, 0.25f)));
    EXPECT_FALSE(filter.shows(measured(of_class, 0.9f, 0.24f)));
  }
  filter = {true, true, true};
  filter.uncertain = true;
  EXPECT_FALSE(filter.shows(measured(VoxelClass::occupied, 0.9f, 0.4f))) << "in place of the classes";
  EXPECT_FALSE(filter.shows(Voxel{})) << "what nobody measured is most uncertain";
}

/// 4 x 4 x 4 voxels from the origin on, an eighth of a metre wide: centres at 0.0625, 0.1875, 0.3125 and 0.4375,
/// exactly.
const VoxelGrid grid{0.125, {0, 0, 0}, {4, 4, 4}};

/// Expects that of all voxels those are shown whose cell `is_shown`.
template <class IsShown>
void expect_shown(const VoxelFilter& filter, IsShown is_shown) {
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
    const Eigen::Vector3i cell = grid.cell(v);
    EXPECT_EQ(filter.shows(grid, v, measured(VoxelClass::occupied, 0.9f)), is_shown(cell)) << cell.transpose();
    EXPECT_FALSE(filter.shows(grid, v, measured(VoxelClass::free, 0.1f))) << "wherever it is";
  }
}

TEST(VoxelFilter, ASliceHoldsTheCentresBetweenItsEnds) {
  VoxelFilter filter;
  expect_shown(filter, [](const Eigen::Vector3i&) { return true; });
  for (int axis = 0; axis < 3; ++axis) {
    filter.slice = Slice{axis, 0.1875, 0.3125};
    expect_shown(filter, [axis](const Eigen::Vector3i& cell) { return cell[axis] == 1 || cell[axis] == 2; });
    filter.slice = Slice{axis, 0.19, 0.31};
    expect_shown(filter, [](const Eigen::Vector3i&) { return false; });
  }
}

TEST(VoxelFilter, ASectionLeavesTheHalfThatItKeeps) {
  VoxelFilter filter;
  for (int axis = 0; axis < 3; ++axis) {
    filter.section = Section{axis, 0.1875, false};
    expect_shown(filter, [axis](const Eigen::Vector3i& cell) { return cell[axis] <= 1; });
    filter.section = Section{axis, 0.1875, true};
    expect_shown(filter, [axis](const Eigen::Vector3i& cell) { return cell[axis] >= 1; });
  }
}

TEST(VoxelFilter, SliceAndSectionHoldTogether) {
  VoxelFilter filter;
  for (int axis = 0; axis < 3; ++axis)
    for (int other = 0; other < 3; ++other) {
      filter.slice = Slice{axis, 0.1, 0.5};  // all but the first
      filter.section = Section{other, 0.3, false};
      expect_shown(filter, [&](const Eigen::Vector3i& cell) { return cell[axis] >= 1 && cell[other] <= 1; });
    }
}

TEST(VoxelFilter, SlicesAndSectionsLieFlatUnlessTheyAreTurned) {
  VoxelFilter filter;
  filter.slice.emplace();
  filter.slice->low = 0.1, filter.slice->high = 0.2;
  expect_shown(filter, [](const Eigen::Vector3i& cell) { return cell.z() == 1; });
  filter.slice.reset();
  filter.section.emplace();
  filter.section->at = 0.1;
  expect_shown(filter, [](const Eigen::Vector3i& cell) { return cell.z() == 0; });
}

TEST(Section, LiesWhereItSaysAndLooksIntoWhatIsLeft) {
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const Section section{axis, -0.5, upper};
      EXPECT_EQ(section.origin()[axis], -0.5);
      EXPECT_EQ(section.origin().norm(), 0.5) << "on the axis";
      EXPECT_EQ(section.inward().norm(), 1.0);
      EXPECT_TRUE(section.holds(Eigen::Vector3d(section.origin() + 0.1 * section.inward())));
      EXPECT_FALSE(section.holds(Eigen::Vector3d(section.origin() - 0.1 * section.inward())));
      EXPECT_TRUE(section.holds(section.origin()));
    }
}

}  // namespace
}  // namespace nextview

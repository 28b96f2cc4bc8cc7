#include "core/map/distance_transform.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>
#include <stdexcept>

#include "tests/unit/map/instruction_sets.hpp"
#include "tests/unit/map/made_rows.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;
using made_rows::cells;
using made_rows::random_rows;

void expect_brute_force(const BitRows& from, const BitRows& to) {
  const auto squared = squared_distances(from, to);
  std::size_t place = 0;
  for (const Vector3i& cell : cells(from)) {
    int nearest = infinitely_far;
    for (const Vector3i& other : cells(to)) nearest = std::min(nearest, (other - cell).squaredNorm());
    ASSERT_LT(place, squared.size());
    ASSERT_EQ(squared[place++], nearest) << cell.transpose();
  }
  EXPECT_EQ(squared.size(), place);
}

const Vector3i sizes[] = {{1, 1, 1},   {7, 1, 1}, {1, 9, 1}, {1, 1, 5},  {13, 11, 1}, {1, 7, 17}, {9, 1, 5},  {8, 3, 2},
                          {11, 13, 7}, {3, 5, 9}, {2, 2, 2}, {29, 3, 2}, {64, 3, 2},  {65, 2, 3}, {131, 3, 2}};

class DistanceTransformOn : public OnInstructionSet {};
INSTANTIATE_TEST_SUITE_P(InstructionSets, DistanceTransformOn, instruction_sets(), instruction_set_name);

TEST_P(DistanceTransformOn, IsWhatComparingAllVoxelsFinds) {
  std::mt19937 random(1);
  for (const Vector3i& size : sizes)
    for (const double to : {0.003, 0.02, 0.3, 0.9})
      for (const double from : {0.05, 0.7}) {
        SCOPED_TRACE(::testing::Message() << size.transpose() << ", " << to << ", " << from);
        expect_brute_force(random_rows(random, size, from), random_rows(random, size, to));
      }
}

// A wall of them, as free space is around an object: behind it nothing in front counts.
TEST(DistanceTransform, HolesInWhatIsFull) {
  std::mt19937 random(2);
  const Vector3i size(21, 19, 17);
  const BitRows full = BitRows(size).complement();
  for (const double share : {0.01, 0.2}) {
    const BitRows holes = random_rows(random, size, share);
    expect_brute_force(holes, holes.complement());
    expect_brute_force(full, holes.complement());
  }
}

TEST(DistanceTransform, OneIsSeenFromEverywhere) {
  const Vector3i size(9, 7, 11);
  for (const Vector3i& cell : {Vector3i(0, 0, 0), Vector3i(1, 4, 1), Vector3i(8, 6, 10)}) {
    BitRows one(size);
    one.set(cell);
    expect_brute_force(BitRows(size).complement(), one);
  }
}

TEST(DistanceTransform, NoneAndAll) {
  for (const Vector3i& size : sizes) {
    const BitRows none(size), all = none.complement();
    const auto voxels = std::size_t(size.prod());
    EXPECT_EQ(squared_distances(all, none), std::vector<std::int32_t>(voxels, infinitely_far));
    EXPECT_EQ(squared_distances(all, all), std::vector<std::int32_t>(voxels, 0));
    EXPECT_TRUE(squared_distances(none, all).empty());
  }
  for (const Vector3i& size : {Vector3i(0, 0, 0), Vector3i(0, 5, 3), Vector3i(4, 4, 0)})
    EXPECT_TRUE(squared_distances(BitRows(size), BitRows(size)).empty());
}

// The longest way that a region of interest has room for: 1024 voxels along each axis.
TEST(DistanceTransform, FarOnesAreNotTakenForNone) {
  for (int axis = 0; axis < 3; ++axis) {
    Vector3i size = Vector3i::Ones();
    size[axis] = 1024;
    BitRows one(size);
    one.set(Vector3i::Zero());
    const auto squared = squared_distances(one.complement(), one);
    for (int i = 1; i < 1024; ++i) ASSERT_EQ(squared[std::size_t(i - 1)], i * i);
  }
}

TEST(DistanceTransform, TheSameOnOneThreadAndTwo) {
  std::mt19937 random(2);
  const Vector3i size(61, 47, 53);
  const BitRows from = random_rows(random, size, 0.4), to = random_rows(random, size, 0.001);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return squared_distances(from, to);
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(DistanceTransform, DifferentSizesAreRefused) {
  EXPECT_THROW(squared_distances(BitRows({2, 2, 3}), BitRows({2, 2, 2})), std::invalid_argument);
  EXPECT_THROW(squared_distances(BitRows({1, 1, 1}), BitRows()), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

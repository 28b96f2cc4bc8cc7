#include "core/map/distance_transform.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <random>
#include <stdexcept>

namespace nextview {
namespace {

using Eigen::Vector3i;
using Flags = std::vector<std::uint8_t>;

std::size_t voxels(const Vector3i& size) { return std::size_t(size.prod()); }

Vector3i cell(int i, const Vector3i& size) {
  return {i % size.x(), i / size.x() % size.y(), i / (size.x() * size.y())};
}

Flags random_flags(std::mt19937& random, const Vector3i& size, double share) {
  std::bernoulli_distribution is(share);
  Flags flags(voxels(size));
  for (auto& flag : flags) flag = is(random) ? std::uint8_t(1 + random() % 255) : 0;  // anything but 0 is a feature
  return flags;
}

void expect_brute_force(const Flags& flags, const Vector3i& size) {
  const auto squared = squared_distances(flags, size);
  const auto counts = neighbour_counts(flags, size);
  ASSERT_EQ(squared.size(), flags.size());
  ASSERT_EQ(counts.size(), flags.size());
  for (int i = 0; i < int(flags.size()); ++i) {
    int nearest = std::numeric_limits<int>::max(), neighbours = 0;
    for (int k = 0; k < int(flags.size()); ++k) {
      if (!flags[std::size_t(k)]) continue;
      const Vector3i apart = cell(k, size) - cell(i, size);
      nearest = std::min(nearest, apart.squaredNorm());
      neighbours += k != i && apart.cwiseAbs().maxCoeff() == 1;
    }
    ASSERT_EQ(squared[std::size_t(i)], std::min(nearest, infinitely_far)) << cell(i, size).transpose();
    ASSERT_EQ(counts[std::size_t(i)], neighbours) << cell(i, size).transpose();
  }
}

const Vector3i sizes[] = {{1, 1, 1}, {7, 1, 1},   {1, 9, 1}, {1, 1, 5}, {13, 11, 1}, {1, 7, 17},
                          {9, 1, 5}, {11, 13, 7}, {3, 5, 9}, {2, 2, 2}, {29, 3, 2}};

TEST(DistanceTransform, IsWhatComparingAllVoxelsFinds) {
  std::mt19937 random(1);
  for (const Vector3i& size : sizes)
    for (const double share : {0.003, 0.02, 0.3, 0.9}) {
      SCOPED_TRACE(::testing::Message() << size.transpose() << ", " << share);
      expect_brute_force(random_flags(random, size, share), size);
    }
}

TEST(DistanceTransform, OneFeatureIsSeenFromEverywhere) {
  const Vector3i size(9, 7, 11);
  for (const int feature : {0, 100, int(voxels(size)) - 1}) {
    Flags flags(voxels(size), 0);
    flags[std::size_t(feature)] = 1;
    expect_brute_force(flags, size);
  }
}

TEST(DistanceTransform, NoFeaturesAndNothingElse) {
  for (const Vector3i& size : sizes) {
    for (const std::int32_t squared : squared_distances(Flags(voxels(size), 0), size))
      ASSERT_EQ(squared, infinitely_far);
    for (const std::int32_t squared : squared_distances(Flags(voxels(size), 1), size)) ASSERT_EQ(squared, 0);
    expect_brute_force(Flags(voxels(size), 0), size);
    expect_brute_force(Flags(voxels(size), 1), size);
  }
  for (const Vector3i& size : {Vector3i(0, 0, 0), Vector3i(0, 5, 3), Vector3i(4, 4, 0)}) {
    EXPECT_TRUE(squared_distances({}, size).empty());
    EXPECT_TRUE(neighbour_counts({}, size).empty());
  }
}

// The longest way that a region of interest has room for: 1024 voxels along each axis, here along one.
TEST(DistanceTransform, FarFeaturesAreNotTakenForNone) {
  const Vector3i size(1024, 1, 1);
  Flags flags(voxels(size), 0);
  flags.front() = 1;
  const auto squared = squared_distances(flags, size);
  for (int x = 0; x < size.x(); ++x) ASSERT_EQ(squared[std::size_t(x)], x * x);
}

TEST(DistanceTransform, TheSameOnOneThreadAndTwo) {
  std::mt19937 random(2);
  const Vector3i size(61, 47, 53);
  const Flags flags = random_flags(random, size, 0.001);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return std::pair(squared_distances(flags, size), neighbour_counts(flags, size));
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(DistanceTransform, WrongSizesAreRefused) {
  const Flags eight(8, 1);
  for (const Vector3i& size : {Vector3i(2, 2, 3), Vector3i(2, 2, 1), Vector3i(0, 0, 0), Vector3i(-2, -2, 2)}) {
    EXPECT_THROW(squared_distances(eight, size), std::invalid_argument) << size.transpose();
    EXPECT_THROW(neighbour_counts(eight, size), std::invalid_argument) << size.transpose();
  }
  EXPECT_THROW(squared_distances({}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(neighbour_counts({}, {1, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

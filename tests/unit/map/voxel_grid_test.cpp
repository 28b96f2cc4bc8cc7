#include "core/map/voxel_grid.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <random>

namespace nextview {
namespace {

TEST(VoxelGrid, IndicesRunAlongXFirst) {
  const VoxelGrid grid{0.1, {-2, 5, 7}, {3, 4, 5}};
  ASSERT_EQ(grid.voxel_count(), 60u);
  std::uint32_t expected = 0;
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 3; ++x, ++expected) {
        EXPECT_EQ(grid.index({x, y, z}), expected);
        EXPECT_EQ(grid.cell(expected), Eigen::Vector3i(x, y, z));
        EXPECT_EQ(grid.cell_at(grid.centre(expected)), Eigen::Vector3i(x, y, z));
        EXPECT_LT((grid.centre(expected) - 0.1 * Vector3(x - 1.5, y + 5.5, z + 7.5)).norm(), 1e-12);
      }
  EXPECT_FALSE(grid.contains({-1, 0, 0}));
  EXPECT_FALSE(grid.contains({0, 4, 0}));
  EXPECT_TRUE(grid.contains({2, 3, 4}));
}

TEST(VoxelGrid, CellsAreOctoMapsKeys) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> d(-3, 3);
  for (const double resolution : {0.005, 0.01, 0.02, 0.03, 0.07}) {
    const octomap::OcTree tree(resolution);
    const VoxelGrid grid{resolution, Eigen::Vector3i::Zero(), Eigen::Vector3i::Ones()};
    for (int n = 0; n < 20'000; ++n) {
      Vector3 p(d(random), d(random), d(random));
      if (n % 2) p = (p / resolution).array().round() * resolution;  // on faces
      const Eigen::Vector3f single = p.cast<float>();
      const Eigen::Vector3i cell = grid.cell_at(single.cast<double>());
      const octomap::OcTreeKey key = tree.coordToKey(octomap::point3d(single.x(), single.y(), single.z()));
      ASSERT_EQ(cell + Eigen::Vector3i::Constant(32768), Eigen::Vector3i(key[0], key[1], key[2])) << single.transpose();
    }
  }
}

TEST(RegionOfInterest, IsACubeOnTheLatticeAroundItsCentre) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> d(-2, 2), edges(0.05, 2);
  for (int n = 0; n < 2000; ++n) {
    const Vector3 centre(d(random), d(random), d(random));
    const double edge = edges(random), resolution = n % 2 ? 0.01 : 0.037;
    const VoxelGrid grid = region_of_interest(centre, edge, resolution);
    EXPECT_EQ(grid.size, Eigen::Vector3i::Constant(int(std::ceil(edge / resolution))));
    const Vector3 offset = 0.5 * (grid.lower() + grid.upper()) - centre;
    EXPECT_LE(offset.cwiseAbs().maxCoeff(), 0.5 * resolution + 1e-9);
  }
}

TEST(RegionOfInterest, IsThePapersCubeAtItsSettings) {
  EXPECT_EQ(region_of_interest(Vector3::Zero(), 1.28, 0.01).voxel_count(), 2'097'152u);
  EXPECT_EQ(region_of_interest(Vector3::Zero(), 0.3, 0.1).size, Eigen::Vector3i::Constant(3));  // 0.3 / 0.1 > 3 - 1e-16
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.28, 0.01);
  EXPECT_EQ(grid.first, Eigen::Vector3i::Constant(-64));
}

TEST(RegionOfInterest, OfABoxIsAllVoxelsItReachesInto) {
  const auto region = [](const Vector3& lower, const Vector3& upper, double resolution) {
    return region_of_interest(Eigen::AlignedBox3d(lower, upper), resolution);
  };
  const VoxelGrid exact = region({-0.4, -0.3, 0}, {0.4, 0.3, 0.8}, 0.01);
  EXPECT_EQ(exact.first, Eigen::Vector3i(-40, -30, 0));
  EXPECT_EQ(exact.size, Eigen::Vector3i(80, 60, 80));
  const VoxelGrid between = region({-0.401, 0.009, 0.5}, {-0.4, 0.011, 0.505}, 0.01);
  EXPECT_EQ(between.first, Eigen::Vector3i(-41, 0, 50));
  EXPECT_EQ(between.size, Eigen::Vector3i(1, 2, 1));
  const double nan = std::nan("");
  EXPECT_THROW(region({0, 0, 0}, {1, 1, 0}, 0.1), std::invalid_argument);
  EXPECT_THROW(region({0, 0, 0}, {1, 1, nan}, 0.1), std::invalid_argument);
  EXPECT_THROW(region({0, 0, 0}, {1, 1, 11}, 0.01), std::invalid_argument);
  EXPECT_THROW(region({1e4, 0, 0}, {1e4 + 1, 1, 1}, 0.01), std::invalid_argument);
  EXPECT_THROW(region_of_interest(Eigen::AlignedBox3d(), 0.1), std::invalid_argument);
}

TEST(RegionOfInterest, RejectsWhatHasNoVoxelsOrTooMany) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, nan, infinity, -infinity}) {
    EXPECT_THROW(region_of_interest(Vector3::Zero(), bad, 0.01), std::invalid_argument) << bad;
    EXPECT_THROW(region_of_interest(Vector3::Zero(), 1.0, bad), std::invalid_argument) << bad;
  }
  EXPECT_THROW(region_of_interest(Vector3::Zero(), 1.0, 1e-5), std::invalid_argument);
  EXPECT_THROW(region_of_interest(Vector3::Zero(), 1e300, 1e-300), std::invalid_argument);
  EXPECT_THROW(region_of_interest(Vector3(nan, 0, 0), 1.0, 0.01), std::invalid_argument);
  EXPECT_THROW(region_of_interest(Vector3(0, 1e30, 0), 1.0, 0.01), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

#include "core/map/ray_tiles.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace nextview {
namespace {

/// As bytes, so that NaN is like itself.
std::vector<std::array<std::uint32_t, 3>> sorted_bytes(const PointCloud& points) {
  std::vector<std::array<std::uint32_t, 3>> all(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) std::memcpy(&all[i], points[i].data(), sizeof all[i]);
  std::ranges::sort(all);
  return all;
}

/// The ends of an image's rays, row by row.
PointCloud image_rays(const Eigen::Vector3f& origin, int columns, int rows) {
  PointCloud ends;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      ends.push_back(origin + Eigen::Vector3f(1.0f, 0.002f * float(x - columns / 2), 0.002f * float(y - rows / 2)));
  return ends;
}

TEST(RayTiles, AreTheSameRaysThoseOfATileTogether) {
  const Eigen::Vector3f origin(0.3f, -0.2f, 0.1f);
  const PointCloud ends = image_rays(origin, 200, 150), ordered = in_tiles(origin, ends);
  EXPECT_EQ(sorted_bytes(ordered), sorted_bytes(ends));
  // How far apart the rays are that are walked one after the other: those of a row, or of a tile 0.04 rad wide.
  const auto mean_spread = [&](const PointCloud& rays) {
    constexpr std::size_t together = 256;
    double sum = 0.0;
    for (std::size_t first = 0; first + together <= rays.size(); first += together) {
      double widest = 0.0;
      for (std::size_t i = first; i < first + together; ++i)
        widest = std::max<double>(widest, (rays[i] - rays[first]).norm());
      sum += widest;
    }
    return sum / double(rays.size() / together);
  };
  EXPECT_GT(mean_spread(ends), 0.2);
  EXPECT_LT(mean_spread(ordered), 0.1);
}

TEST(RayTiles, WildRaysAreKept) {
  constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  PointCloud ends;
  EXPECT_TRUE(in_tiles({0, 0, 0}, ends).empty());
  for (int i = 0; i < 1000; ++i) ends.emplace_back(uniform(random), uniform(random), uniform(random));
  ends[0].setZero(), ends[64].setConstant(nan), ends[65].setConstant(infinity), ends[66].setConstant(-3e38f);
  EXPECT_EQ(sorted_bytes(in_tiles({0, 0, 0}, ends)), sorted_bytes(ends));
  EXPECT_EQ(in_tiles({nan, 0, 0}, ends).size(), ends.size());
}

}  // namespace
}  // namespace nextview

#include "core/cloud/neighbour_distances.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/cloud/point_grid.hpp"

namespace nextview {
namespace {

/// Of all points, one by one.
std::vector<float> squared_to_all(const PointCloud& points, const Eigen::Vector3f& from) {
  std::vector<float> squared;
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3f way = from - p;
    squared.push_back(way.x() * way.x() + way.y() * way.y() + way.z() * way.z());
  }
  std::sort(squared.begin(), squared.end());
  return squared;
}
std::vector<float> twin(const PointCloud& points, int neighbours) {
  std::vector<float> distances;
  for (const Eigen::Vector3f& from : points) {
    const std::vector<float> squared = squared_to_all(points, from);
    double sum = 0.0;
    for (std::size_t k = 1; k < squared.size() && k <= std::size_t(neighbours); ++k)
      sum += std::sqrt(double(squared[k]));
    distances.push_back(float(sum / neighbours));
  }
  return distances;
}

/// Kinds of clouds: a sheet, a line, a heap, a sheet that gets sparse to one side and lies far from the origin, lines
/// along the other axes.
constexpr int kinds_of_clouds = 6;
PointCloud cloud_of(int kind, std::mt19937& random, int count) {
  std::uniform_real_distribution<float> u(-0.2f, 0.2f);
  PointCloud points;
  for (int i = 0; i < count; ++i) {
    const float x = u(random), y = u(random), z = u(random);
    const Eigen::Vector3f kinds[] = {{x, y, 0.01f * z + 0.7f},      {x, 0.0f, 0.0f}, {x, y, z},
                                     {80.0f + 9 * x * x, y, 30.0f}, {0.0f, y, 0.0f}, {0.0f, 0.0f, z}};
    points.push_back(kinds[kind]);
  }
  return points;
}

TEST(NeighbourDistances, AreThoseOfAllPointsOneByOne) {
  std::mt19937 random(1);
  for (int kind = 0; kind < kinds_of_clouds; ++kind)
    for (const int count : {1, 2, 17, 700})
      for (const int outliers : {0, 3, 30}) {
        PointCloud points = cloud_of(kind, random, count);
        for (int i = 0; i < outliers; ++i) points.push_back(5.0f * cloud_of(2, random, 1)[0]);
        for (const int neighbours : {1, 5, 16})
          EXPECT_EQ(neighbour_distances(points, neighbours), twin(points, neighbours))
              << kind << ", " << count << ", " << outliers << ", " << neighbours;
      }
}

TEST(NeighbourDistances, OfEqualPointsAreZero) {
  const PointCloud points(40, Eigen::Vector3f(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(neighbour_distances(points, 8), std::vector<float>(40, 0.0f));
}

// A grid says where it does not know, and that is seldom.
TEST(PointGrid, FindsTheNearestOnesOfMostPoints) {
  std::mt19937 random(2);
  PointCloud points = cloud_of(0, random, 3000);
  for (int i = 0; i < 20; ++i) points.push_back(5.0f * cloud_of(2, random, 1)[0]);
  const PointGrid grid(points, 17);
  std::size_t found = 0;
  std::vector<float> squared;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (!grid.nearest(i, 17, squared)) continue;
    std::vector<float> expected = squared_to_all(points, points[grid.number(i)]);
    expected.resize(17);
    EXPECT_EQ(squared, expected);
    ++found;
  }
  EXPECT_GT(found, 2700u);
}

}  // namespace
}  // namespace nextview

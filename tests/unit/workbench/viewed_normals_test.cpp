// The normals that points are shaded by, against a ball's and a plate's.
#include "ui/workbench/viewed_normals.hpp"

#include <gtest/gtest.h>

#include <random>

namespace nextview {
namespace {

/// What a camera at x = 1 sees of a ball of 0.2 m around the origin, with noise.
Scan scan_of_ball(double noise) {
  Scan scan;
  scan.origin = {1, 0, 0};
  std::mt19937 random(3);
  std::normal_distribution<double> error(0, noise);
  for (int row = -60; row <= 60; ++row)
    for (int column = -80; column <= 80; ++column) {
      const Vector3 direction = Vector3(-1, 0.003 * column, 0.003 * row).normalized();
      const double middle = -direction.dot(scan.origin), off = scan.origin.squaredNorm() - middle * middle;
      if (off > 0.04) continue;
      scan.hits.push_back((scan.origin + (middle - std::sqrt(0.04 - off) + error(random)) * direction).cast<float>());
    }
  return scan;
}

TEST(ViewedNormals, OfABallPointOutOfIt) {
  const Scan scan = scan_of_ball(0.0005);
  const auto normals = viewed_normals(scan, 1);
  ASSERT_EQ(normals.size(), scan.hits.size());
  double sum = 0;
  std::size_t good = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(normals[i].norm(), 1.0f, 1e-4f);
    const float cosine = normals[i].dot(scan.hits[i].normalized());
    sum += cosine;
    good += cosine > 0.94f;  // 20 degrees
  }
  EXPECT_GT(good, normals.size() * 9 / 10);
  EXPECT_GT(sum / double(normals.size()), 0.96);
}

TEST(ViewedNormals, AreOneForEachPointThatIsAskedFor) {
  const Scan scan = scan_of_ball(0);
  EXPECT_EQ(viewed_normals(scan, 7).size(), (scan.hits.size() + 6) / 7);
  EXPECT_TRUE(viewed_normals(Scan{}, 3).empty());
  Scan one;
  one.origin = {1, 0, 0};
  one.hits = {{0, 0, 0}};
  EXPECT_EQ(viewed_normals(one, 1).at(0), Eigen::Vector3f(1, 0, 0)) << "towards the camera";
}

TEST(ViewedNormals, OfTwoPlatesAreNotMixedAtTheStep) {
  Scan scan;
  scan.origin = {0, 0, 1};
  for (int row = -50; row < 50; ++row)
    for (int column = -50; column < 50; ++column)
      scan.hits.emplace_back(0.004f * float(column), 0.004f * float(row), column < 0 ? 0.0f : 0.1f);
  std::size_t tilted = 0;
  for (const auto& normal : viewed_normals(scan, 1)) tilted += normal.z() < 0.9f;
  EXPECT_LT(tilted, scan.hits.size() / 15) << "more than the cells at the step";
}

/// A strip of a wall, a hundred times as long as wide, seen from beneath: it rises by an angle from one long side to
/// the other, and lies along y or along x.
Scan scan_of_strip(bool along_y, double angle) {
  Scan scan;
  scan.origin = {0, 0, -1};
  for (int across = -1; across <= 1; ++across)
    for (int along = -150; along <= 150; ++along) {
      const double a = 0.001 * across, b = 0.001 * along;
      scan.hits.emplace_back(float(along_y ? a : b), float(along_y ? b : a), float(std::tan(angle) * a));
    }
  return scan;
}

TEST(ViewedNormals, OfAStripTwoCellsWideAreThoseOfItsWall) {
  for (const bool along_y : {true, false})
    for (const double angle : {-0.6, 0.0, 0.6}) {
      const Scan scan = scan_of_strip(along_y, angle);
      const Vector3 wall(along_y ? std::sin(angle) : 0, along_y ? 0 : std::sin(angle), -std::cos(angle));
      const auto normals = viewed_normals(scan, 1);
      ASSERT_EQ(normals.size(), scan.hits.size());
      for (const Eigen::Vector3f& normal : normals)
        ASSERT_GT(normal.cast<double>().dot(wall), 0.999) << along_y << " at " << angle;
    }
}

/// A wall that is seen slantwise, from a camera anywhere that looks anywhere.
TEST(ViewedNormals, OfAWallAreItsOwnFromAnywhere) {
  for (const Vector3& forward : {Vector3(1, 0, 0), Vector3(0, 0, -1), Vector3(-0.3, 0.9, 0.2)}) {
    const Vector3 ahead = forward.normalized(), right = ahead.unitOrthogonal(), up = ahead.cross(right);
    const Vector3 wall = (-ahead + 0.5 * right - 0.3 * up).normalized();
    Scan scan;
    scan.origin = Vector3(3, -2, 1);
    const Vector3 middle = scan.origin + 0.8 * ahead;
    for (int row = -40; row <= 40; ++row)
      for (int column = -40; column <= 40; ++column) {
        const Vector3 sight = ahead + 0.004 * (row * up + column * right);
        scan.hits.push_back((scan.origin + (middle - scan.origin).dot(wall) / sight.dot(wall) * sight).cast<float>());
      }
    std::size_t own = 0;
    for (const Eigen::Vector3f& normal : viewed_normals(scan, 1)) own += normal.cast<double>().dot(wall) > 0.999;
    EXPECT_GT(own, scan.hits.size() * 99 / 100) << "all but corners, whose cells have no neighbours";
  }
}

}  // namespace
}  // namespace nextview

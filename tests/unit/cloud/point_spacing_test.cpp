#include "core/cloud/point_spacing.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

/// A lattice in a plane, far from the origin.
PointCloud lattice(int columns, int rows, float spacing) {
  PointCloud points;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      points.emplace_back(8.0f + spacing * float(column), 3.0f, spacing * float(row));
  return points;
}

TEST(PointSpacing, IsThatOfALattice) {
  for (const int side : {2, 10, 31, 32, 100})  // up to a thousand points, each is looked at; of more, some
    for (const float spacing : {0.002f, 0.25f})
      EXPECT_NEAR(point_spacing(lattice(side, side, spacing)), spacing, 1e-5) << side;
}

TEST(PointSpacing, IsTheMedianAndNotTheMean) {
  PointCloud points = lattice(20, 20, 0.01f);
  for (int i = 0; i < 40; ++i) points.emplace_back(0.0f, 100.0f + 10.0f * float(i), 0.0f);
  EXPECT_NEAR(point_spacing(points), 0.01, 1e-5);
}

TEST(PointSpacing, OfFewerThanTwoIsNone) {
  EXPECT_EQ(point_spacing({}), 0.0);
  EXPECT_EQ(point_spacing({{1, 2, 3}}), 0.0);
  EXPECT_NEAR(point_spacing({{1, 2, 3}, {1, 2, 5}}), 2.0, 1e-6);
}

}  // namespace
}  // namespace nextview

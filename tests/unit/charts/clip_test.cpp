// Lines cut off at a box, against what their points say one by one.
#include <gtest/gtest.h>

#include <random>

#include "ui/charts/page.hpp"

namespace nextview {
namespace {

const Eigen::AlignedBox2d box(Eigen::Vector2d(0, 0), Eigen::Vector2d(10, 4));

LinePiece piece(double x1, double y1, double x2, double y2) {
  return {Eigen::Vector2d(x1, y1), Eigen::Vector2d(x2, y2)};
}

TEST(Clip, LinesAlongASideAreInOrOut) {
  for (const double y : {-1.0, 5.0}) {
    LinePiece beside = piece(2, y, 8, y);
    EXPECT_FALSE(clip(beside, box)) << y;
    LinePiece back = piece(8, y, 2, y);
    EXPECT_FALSE(clip(back, box)) << y;
  }
  for (const double x : {-1.0, 11.0}) {
    LinePiece beside = piece(x, 1, x, 3);
    EXPECT_FALSE(clip(beside, box)) << x;
  }
  for (const double y : {0.0, 2.0, 4.0}) {
    LinePiece across = piece(-5, y, 25, y);
    ASSERT_TRUE(clip(across, box)) << y;
    EXPECT_LT((across[0] - Eigen::Vector2d(0, y)).norm(), 1e-12);
    EXPECT_LT((across[1] - Eigen::Vector2d(10, y)).norm(), 1e-12);
  }
  LinePiece upright = piece(10, 7, 10, -3);
  ASSERT_TRUE(clip(upright, box));
  EXPECT_LT((upright[0] - Eigen::Vector2d(10, 4)).norm(), 1e-12) << "it keeps its direction";
  EXPECT_LT((upright[1] - Eigen::Vector2d(10, 0)).norm(), 1e-12);
}

TEST(Clip, WhatIsRefusedStaysAsItIs) {
  LinePiece outside = piece(-3, 1, -1, 3), corner = piece(-1, 1, 1, -1);
  EXPECT_FALSE(clip(outside, box));
  EXPECT_EQ(outside, piece(-3, 1, -1, 3));
  EXPECT_FALSE(clip(corner, box)) << "it meets a corner alone";
}

/// Whole numbers, so that many lines run along an axis, through corners, or are a point.
TEST(Clip, KeepsOfAnyLineThePointsThatLieInTheBox) {
  std::mt19937 random(3);
  const auto within = [&](int low, int high) { return low + int(random() % unsigned(high - low + 1)); };
  constexpr int steps = 400;
  int kept = 0;
  for (int n = 0; n < 2000; ++n) {
    const LinePiece whole = piece(within(-6, 16), within(-5, 9), within(-6, 16), within(-5, 9));
    const Eigen::Vector2d way = whole[1] - whole[0];
    LinePiece cut = whole;
    const bool is_kept = clip(cut, box);
    kept += is_kept;
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector2d point = whole[0] + double(i) / steps * way;
      if (box.exteriorDistance(point) > 0 || (point - box.min()).minCoeff() < 1e-9 ||
          (box.max() - point).minCoeff() < 1e-9)
        continue;  // not well within
      ASSERT_TRUE(is_kept) << n;
      EXPECT_GE((point - cut[0]).dot(way), -1e-9) << n;
      EXPECT_GE((cut[1] - point).dot(way), -1e-9) << n;
    }
    if (!is_kept) continue;
    for (const Eigen::Vector2d& end : cut) {
      EXPECT_LT(box.exteriorDistance(end), 1e-9) << n;
      EXPECT_LT(std::abs(way.x() * (end - whole[0]).y() - way.y() * (end - whole[0]).x()), 1e-9)
          << n << ": off the line";
      EXPECT_GE((end - whole[0]).dot(way), -1e-9) << n;
      EXPECT_GE((whole[1] - end).dot(way), -1e-9) << n;
    }
    EXPECT_GE((cut[1] - cut[0]).dot(way), 0.0) << n;
  }
  EXPECT_GT(kept, 500);
  EXPECT_LT(kept, 1800);
}

}  // namespace
}  // namespace nextview

#include "core/gain/surface_slant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace nextview {
namespace {

using Eigen::Vector3i;

TEST(CoarseNormal, TheWaysToVoxelsUpToTwoAwayAreExact) {
  for (int z = -2; z <= 2; ++z)
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x) {
        const Vector3i way(x, y, z);
        if (way.isZero()) continue;
        const Vector3 direction = CoarseNormal::along(way).direction();
        EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
        EXPECT_NEAR(std::abs(direction.dot(way.cast<double>())), way.cast<double>().norm(), 1e-12) << way.transpose();
      }
}

TEST(CoarseNormal, AnyOtherWayIsNotFarFromItsOwn) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> component(-CoarseNormal::farthest, CoarseNormal::farthest);
  double least = 1.0;
  for (int n = 0; n < 5000; ++n) {
    const Vector3i way(component(random), component(random), component(random));
    if (way.isZero()) continue;
    const Vector3 direction = CoarseNormal::along(way).direction();
    least = std::min(least, std::abs(direction.dot(way.cast<double>().normalized())));
    EXPECT_EQ(CoarseNormal::along(-way).direction(), direction) << "either sense is the same";
  }
  EXPECT_GT(least, std::cos(18.0 * std::numbers::pi / 180));
}

TEST(CoarseNormal, CosinesAreThoseOfItsDirection) {
  const Vector3 ray = Vector3(1, 2, -2) / 3;
  EXPECT_NEAR(CoarseNormal::along({0, 5, 0}).squared_cosine(ray), 4.0 / 9, 1e-12);
  EXPECT_NEAR(CoarseNormal::along({0, 4, 4}).squared_cosine(ray), 0.0, 1e-12);
  EXPECT_NEAR(CoarseNormal::along({-1, -2, 2}).squared_cosine(ray), 1.0, 1e-12);
}

TEST(SurfaceSlant, GoesFromEdgeToFace) {
  const SurfaceSlant slant{2.5, 1.25};
  EXPECT_EQ(slant.at(0.0), 2.5);
  EXPECT_EQ(slant.at(1.0), 1.25);
  EXPECT_NEAR(slant.at(0.2), 2.25, 1e-12);
  EXPECT_EQ(slant.times(2.0), (SurfaceSlant{5.0, 2.5}));
}

}  // namespace
}  // namespace nextview

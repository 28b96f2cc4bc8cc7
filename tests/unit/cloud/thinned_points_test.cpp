#include "core/cloud/thinned_points.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

TEST(ThinnedPoints, AreTheMeansOfEachCube) {
  const ThinnedPoints few = thinned({{0.1f, 0.1f, 0.1f}, {-0.5f, 0.0f, 0.0f}, {0.3f, 0.5f, 0.1f}}, 1.0);
  ASSERT_EQ(few.positions.size(), 2u);
  EXPECT_TRUE(few.positions[0].isApprox(Vector3(0.2, 0.3, 0.1), 1e-6));
  EXPECT_EQ(few.counts, (std::vector<std::uint32_t>{2, 1}));
  EXPECT_EQ(few.of_point, (std::vector<std::uint32_t>{0, 1, 0}));
}

TEST(ThinnedPoints, MayLieFarApart) {
  EXPECT_EQ(thinned({{-1e4f, 0, 0}, {1e4f, 1e4f, 1e4f}}, 1e-4).positions.size(), 2u);
  EXPECT_TRUE(thinned({}, 1.0).positions.empty());
  EXPECT_THROW(thinned({}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

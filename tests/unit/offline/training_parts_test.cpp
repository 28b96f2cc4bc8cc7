#include "core/offline/training_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace nextview {
namespace {

bool same(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles;
}

TEST(TrainingParts, AreWatertightOfTheRightSizeAndInTheMiddle) {
  for (const std::uint32_t number : {0u, 1u, 1000u}) {
    const TriangleMesh part = training_part(number, 5);
    SCOPED_TRACE(number);
    EXPECT_GT(part.triangles.size(), 1000u);
    const MeshTopology joined = topology(part);
    EXPECT_TRUE(joined.watertight()) << joined.summary();
    EXPECT_EQ(joined.misoriented_edges, 0u);
    EXPECT_FALSE(joined.inward);
    EXPECT_NEAR(part.bounding_box().sizes().maxCoeff(), 0.5, 1e-6);
    EXPECT_LT(part.bounding_box().center().norm(), 1e-6);
  }
}

TEST(TrainingParts, TheSameNumberAndSeedGiveTheSamePart) {
  const TriangleMesh part = training_part(3, 1);
  EXPECT_TRUE(same(part, training_part(3, 1)));
  EXPECT_FALSE(same(part, training_part(4, 1)));
  EXPECT_FALSE(same(part, training_part(3, 2)));
}

}  // namespace
}  // namespace nextview

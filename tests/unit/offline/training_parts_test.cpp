#include "core/offline/training_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += mesh.vertices[a].cast<double>().dot(mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>()));
  return sum / 6;
}

/// The default gain's numbers were learned from these: whoever changes them has to learn anew.
TEST(TrainingParts, AreThoseThatTheDefaultGainWasFittedTo) {
  std::vector<double> volumes;
  for (std::uint32_t number = 0; number < 8; ++number) volumes.push_back(1e6 * volume(training_part(number, 1)));
  const std::vector<double> expected = {60354.25, 33504.82, 18933.00, 20497.81,
                                        25285.35, 42479.06, 53781.37, 7290.51};  // [cm^3]
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(volumes[i], expected[i], 0.1) << i;
}

/// The read-out of the Gibbs map was learned from these.
TEST(TrainingParts, InDetailAreWatertightAndThoseThatTheReadOutWasFittedTo) {
  const std::vector<double> expected = {19461.30, 19910.22};  // [cm^3]
  for (std::uint32_t number = 1; number <= 2; ++number) {
    const TriangleMesh part = detailed_training_part(number, 19);
    SCOPED_TRACE(number);
    const MeshTopology joined = topology(part);
    EXPECT_TRUE(joined.watertight()) << joined.summary();
    EXPECT_FALSE(joined.inward);
    EXPECT_NEAR(part.bounding_box().sizes().maxCoeff(), 0.5, 0.05);
    EXPECT_LT(part.bounding_box().center().norm(), 0.03);
    EXPECT_NEAR(1e6 * volume(part), expected[number - 1], 0.1);
    EXPECT_TRUE(number == 2 || same(part, detailed_training_part(number, 19)));
  }
}

}  // namespace
}  // namespace nextview

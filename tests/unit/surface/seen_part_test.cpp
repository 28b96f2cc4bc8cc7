// What of a surface was seen, and how that is said.
#include "core/surface/seen_part.hpp"

#include <gtest/gtest.h>

#include "tests/unit/surface/surface_checks.hpp"

namespace nextview {
namespace {

using surface_checks::Triangles;

/// Two squares of one edge side by side, and a vertex that nothing needs: of 0.02 m² the right half touches a corner
/// that was not seen.
Surface strip() {
  Surface surface;
  surface.mesh.vertices = {{9, 9, 9},    {0, 0, 0},       {0.1f, 0, 0},   {0.2f, 0, 0},
                           {0, 0.1f, 0}, {0.1f, 0.1f, 0}, {0.2f, 0.1f, 0}};
  surface.mesh.triangles = {{1, 2, 5}, {2, 3, 6}, {1, 5, 4}, {2, 6, 5}};
  surface.uncertainty = {0.9f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
  surface.seen = {1, 1, 1, 1, 1, 1, 0};
  return surface;
}

TEST(SeenPart, ATriangleIsSeenIfAllOfItsCornersAre) {
  EXPECT_EQ(seen_part(strip()).triangles, (Triangles{{1, 2, 5}, {1, 5, 4}}));
  EXPECT_EQ(unseen_part(strip()).triangles, (Triangles{{2, 3, 6}, {2, 6, 5}}));
  EXPECT_EQ(seen_part(strip()).vertices, strip().mesh.vertices);
  EXPECT_EQ(unseen_part(strip()).vertices, strip().mesh.vertices);
}

TEST(SeenPart, OfItsOwnHasTheVerticesThatItNeeds) {
  const Surface seen = seen_surface(strip()), unseen = unseen_surface(strip());
  EXPECT_EQ(seen.mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(seen.uncertainty, (std::vector<float>{0.1f, 0.2f, 0.5f, 0.4f})) << "as they are first used";
  EXPECT_EQ(seen.seen, (std::vector<std::uint8_t>{1, 1, 1, 1}));
  EXPECT_EQ(seen.mesh.vertices[3], strip().mesh.vertices[4]);
  EXPECT_EQ(unseen.uncertainty, (std::vector<float>{0.2f, 0.3f, 0.6f, 0.5f}));
  EXPECT_EQ(unseen.seen, (std::vector<std::uint8_t>{1, 1, 0, 1}));
  EXPECT_NEAR(seen.mesh.surface_area(), 0.01, 1e-8);
}

TEST(SeenArea, AddsUpTheTriangles) {
  const SeenArea area = seen_area(strip());
  EXPECT_NEAR(area.seen, 0.01, 1e-8);
  EXPECT_NEAR(area.unseen, 0.01, 1e-8);
  EXPECT_EQ(area.percent_seen(), "50 %");
}

TEST(SeenArea, IsSaidInTheUnitThatTheWholeAsksFor) {
  EXPECT_EQ((SeenArea{0.061, 0.039}.text(0.061)), "0.061 m²");
  EXPECT_EQ((SeenArea{0.061, 0.038}.text(0.061)), "610.0 cm²");
  EXPECT_EQ((SeenArea{2.0, 1.0}.text(0.00004)), "0.000 m²") << "both of a pair in the same unit";
  EXPECT_EQ((SeenArea{0.00006, 0.00005}.text(0.00006)), "0.6 cm²");
  EXPECT_EQ((SeenArea{0.00006, 0.00003}.text(0.00006)), "60.00 mm²");
}

TEST(SeenArea, OnlyNothingIsNoPercentAndOnlyAllIsAHundred) {
  const auto percent = [](double share) { return SeenArea{share, 1.0 - share}.percent_seen(); };
  EXPECT_EQ(percent(0.0), "0 %");
  EXPECT_EQ(percent(0.0001), "less than 1 %");
  EXPECT_EQ(percent(0.0099), "less than 1 %");
  EXPECT_EQ(percent(0.0101), "1 %");
  EXPECT_EQ(percent(0.214), "21 %");
  EXPECT_EQ(percent(0.9899), "99 %");
  EXPECT_EQ(percent(0.9901), "over 99 %");
  EXPECT_EQ(percent(0.9999), "over 99 %");
  EXPECT_EQ(percent(1.0), "100 %");
  EXPECT_EQ(SeenArea{}.percent_seen(), "0 %") << "there is no surface";
}

}  // namespace
}  // namespace nextview

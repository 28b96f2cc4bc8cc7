#include "core/mesh/surface_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nextview {
namespace {

/// A triangle of area 3, one without area, and one of area 1 in another plane.
TriangleMesh uneven() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {6, 0, 0}, {0, 0, 5}, {1, 0, 5}, {0, 2, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}};
  return mesh;
}

TEST(SurfaceSamples, sharesFollowAreasToOneSample) {
  const SurfaceSamples samples = sample_surface(uneven(), 1001, 7);
  ASSERT_EQ(samples.points.size(), 1001u);
  ASSERT_EQ(samples.triangles.size(), 1001u);
  std::array<double, 3> counts{};
  for (const std::uint32_t triangle : samples.triangles) ++counts.at(triangle);
  // Stratified: not within sqrt(n) of the expected share, but within one.
  EXPECT_NEAR(counts[0], 1001 * 0.75, 1.0);
  EXPECT_EQ(counts[1], 0.0);
  EXPECT_NEAR(counts[2], 1001 * 0.25, 1.0);
}

TEST(SurfaceSamples, verticesCountOnceEachWithATriangleOfTheirs) {
  TriangleMesh mesh = uneven();
  mesh.vertices.push_back({9, 9, 9});  // of no triangle
  const SurfaceSamples samples = vertex_samples(mesh);
  EXPECT_EQ(samples.points, uneven().vertices);
  EXPECT_EQ(samples.triangles, (std::vector<std::uint32_t>{0, 0, 0, 1, 2, 2, 2}));
}

TEST(SurfaceSamples, pointsAreUniformOverATriangle) {
  constexpr std::size_t count = 40'000;
  const SurfaceSamples samples = sample_surface(uneven(), count, 3);
  // Over a triangle with corners 0, (3, 0), (0, 2), x/3 and y/2 have mean 1/3 and variance 1/18.
  double sum_x = 0, sum_y = 0, sum_xx = 0, n = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f& p = samples.points[i];
    if (samples.triangles[i] != 0) {
      EXPECT_NEAR(p.z(), 5.f, 1e-6f);
      continue;
    }
    const double x = p.x() / 3, y = p.y() / 2;
    ASSERT_GE(x, 0.0);
    ASSERT_GE(y, 0.0);
    ASSERT_LE(x + y, 1.0 + 1e-6);
    ASSERT_EQ(p.z(), 0.f);
    sum_x += x, sum_y += y, sum_xx += x * x, ++n;
  }
  const double error = 4.0 * std::sqrt(1.0 / 18.0 / n);
  EXPECT_NEAR(sum_x / n, 1.0 / 3.0, error);
  EXPECT_NEAR(sum_y / n, 1.0 / 3.0, error);
  EXPECT_NEAR(sum_xx / n - 1.0 / 9.0, 1.0 / 18.0, error);
}

TEST(SurfaceSamples, theSeedDecides) {
  EXPECT_EQ(sample_surface(uneven(), 50, 1).points, sample_surface(uneven(), 50, 1).points);
  EXPECT_NE(sample_surface(uneven(), 50, 1).points, sample_surface(uneven(), 50, 2).points);
}

TEST(SurfaceSamples, nothingToSampleIsAnError) {
  EXPECT_TRUE(sample_surface(uneven(), 0, 1).points.empty());
  TriangleMesh flat = uneven();
  flat.triangles = {{0, 1, 3}};
  EXPECT_THROW(sample_surface(flat, 10, 1), std::invalid_argument);
  EXPECT_THROW(sample_surface({}, 10, 1), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

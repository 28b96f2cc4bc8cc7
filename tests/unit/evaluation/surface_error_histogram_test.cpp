#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/unit/evaluation/surface_error_of.hpp"
#include "tests/unit/map/closed_meshes.hpp"

namespace nextview {
namespace {

/// The share of the area of a cube of edge 0.1 m, shifted by `shift` along x, that lies off by a distance from `low` to
/// `high` [m] (the distance 0 apart).
double share_of_shifted_cube(double shift, double low, double high) {
  constexpr double edge = 0.1;
  const auto up_to = [&](double d) {  // area that lies off by more than 0 up to d, outside (d > 0) or inside
    const double t = std::min(std::abs(d), shift), rest = edge - 2 * t;
    // Outside: four strips beyond the true cube, and the face in front of it; inside: the rim of the other face (its
    // nearest true face is the one beside it), and its middle.
    const double strips = d > 0 ? 4 * edge * t : edge * edge - rest * rest;
    return strips + (std::abs(d) < shift ? 0.0 : d > 0 ? edge * edge : rest * rest);
  };
  return (low >= 0 ? up_to(high) - (low > 0 ? up_to(low) : 0.0) : up_to(low) - (high < 0 ? up_to(high) : 0.0)) /
         (6 * edge * edge);
}

TEST(SurfaceErrorHistogram, ofAShiftedCubeIsKnown) {
  constexpr double shift = 1.5 * mm;
  const Vector3 half = Vector3::Constant(0.05), along(shift, 0, 0);
  const SurfaceErrorOptions options{.samples = 200'000};
  const SurfaceError result = surface_error_of(seen_surface(closed_meshes::box(along - half, along + half)),
                                               closed_meshes::box(-half, half), options);
  const DistanceHistogram& histogram = result.histogram;
  EXPECT_DOUBLE_EQ(histogram.limit, 2 * mm);
  ASSERT_EQ(histogram.counts.size(), 50u);
  EXPECT_EQ(histogram.below + histogram.above, 0u);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t(0)), options.samples);
  for (std::size_t bin = 0; bin < 50; ++bin) {
    double expected = share_of_shifted_cube(shift, histogram.lower(bin), histogram.lower(bin + 1));
    if (bin == 25) expected += 4 * 0.1 * (0.1 - shift) / (6 * 0.1 * 0.1);  // what lies in the true faces' planes
    const double n = double(options.samples), deviation = std::sqrt(n * expected * (1 - expected));
    EXPECT_NEAR(double(histogram.counts[bin]), n * expected, 5 * deviation) << "bin " << bin;
  }
}

TEST(SurfaceErrorHistogram, countsWhatIsBeyondItsRange) {
  TriangleMesh mesh = closed_meshes::box(Vector3::Constant(-0.05), Vector3::Constant(0.05));
  const TriangleMesh truth = mesh;
  closed_meshes::append(mesh, closed_meshes::box({0.3, 0.3, 0.3}, {0.305, 0.305, 0.305}));  // 0.25 % of the area
  const SurfaceError result = surface_error_of(seen_surface(mesh), truth);
  EXPECT_DOUBLE_EQ(result.histogram.limit, 1e-5);  // 99 % lie on the surface
  EXPECT_NEAR(double(result.histogram.above), 50'000 * 0.0025, 3);
  EXPECT_EQ(result.histogram.counts[25] + result.histogram.above, 50'000u);
  EXPECT_GT(result.largest, 0.4);
  EXPECT_EQ(result.percentile_99, 0.0);
}

TEST(SurfaceErrorHistogram, endsAtARoundNumber) {
  EXPECT_DOUBLE_EQ(scale_end(0.001), 0.001);
  EXPECT_DOUBLE_EQ(scale_end(0.00101), 0.002);
  EXPECT_DOUBLE_EQ(scale_end(0.0021), 0.003);
  EXPECT_DOUBLE_EQ(scale_end(0.031), 0.05);
  EXPECT_DOUBLE_EQ(scale_end(0.51), 1.0);
  EXPECT_DOUBLE_EQ(scale_end(0.0), 1e-5);
}

}  // namespace
}  // namespace nextview

#include "core/map/surface_border.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numbers>
#include <random>

namespace nextview {
namespace {

constexpr double surface_radius = 0.005;

ScannedSurface surface_of(const PointCloud& points) {
  ScannedSurface surface(surface_radius);
  Scan scan;
  scan.hits = points;
  surface.add(scan, Vector3::UnitZ(), 1e-6);
  return surface;
}

/// Of a sphere of 50 mm, as far as `least` times the surface_radius up: about a point a square millimetre.
PointCloud part_of_sphere(float least) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> height(least, 1.0f), angle(0.0f, 2.0f * std::numbers::pi_v<float>);
  PointCloud points;
  for (int i = 0; i < static_cast<int>(31'416 * (1.0f - least) / 2.0f); ++i) {
    const float z = height(generator), a = angle(generator), r = std::sqrt(1.0f - z * z);
    points.push_back(0.05f * Eigen::Vector3f(r * std::cos(a), r * std::sin(a), z));
  }
  return points;
}

TEST(SurfaceBorder, AClosedSurfaceHasNone) {
  const SurfaceBorder border = surface_border(surface_of(part_of_sphere(-1.0f)), 1'000'000);
  EXPECT_GT(border.looked_at, 4'000u);
  EXPECT_TRUE(border.points.empty());
}

TEST(SurfaceBorder, OfHalfASphereIsItsRim) {
  const SurfaceBorder border = surface_border(surface_of(part_of_sphere(0.0f)), 1'000'000);
  // A strip along the rim, about a point wide: 2 pi r times half a radius, of 2 pi r^2.
  EXPECT_NEAR(double(border.points.size()) / double(border.looked_at), 0.5 * surface_radius / 0.05, 0.02);
  for (const SurfaceBorder::Point& point : border.points) {
    EXPECT_LT(point.at.z(), 0.8 * surface_radius);
    EXPECT_LT(point.outward.z(), -0.7f) << "past the rim, along the surface: " << point.outward.transpose();
    EXPECT_NEAR(point.outward.norm(), 1.0f, 1e-5f);
  }
}

TEST(SurfaceBorder, AFoldIsNone) {
  PointCloud points;
  for (float along = 0.0f; along < 0.1f; along += 0.001f)
    for (float across = 0.0005f; across < 0.1f; across += 0.001f)
      points.emplace_back(along, across, 0.0f), points.emplace_back(along, 0.0f, across);
  for (const SurfaceBorder::Point& point : surface_border(surface_of(points), 1'000'000).points) {
    const Eigen::Vector3f& at = point.at;
    const bool at_the_rim = at.x() < 0.005f || at.x() > 0.095f || std::max(at.y(), at.z()) > 0.095f;
    EXPECT_TRUE(at_the_rim) << at.transpose();
  }
}

TEST(SurfaceBorder, ASampleSaysMuchTheSame) {
  const ScannedSurface surface = surface_of(part_of_sphere(0.0f));
  const SurfaceBorder all = surface_border(surface, 1'000'000), some = surface_border(surface, 1'000);
  EXPECT_LT(some.looked_at, 2'000u);
  EXPECT_EQ(all.spacing, 0.5 * surface_radius);
  EXPECT_NEAR(some.spacing * double(some.looked_at), all.spacing * double(all.looked_at),
              0.15 * all.spacing * double(all.looked_at))
      << "a point stands for as many more as are left out";
  EXPECT_NEAR(double(some.points.size()) / double(some.looked_at), double(all.points.size()) / double(all.looked_at),
              0.02);
}

TEST(SurfaceBorder, SameOnAnyNumberOfThreads) {
  const ScannedSurface surface = surface_of(part_of_sphere(0.0f));
  const SurfaceBorder many = surface_border(surface);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const SurfaceBorder one = surface_border(surface);
  ASSERT_EQ(many.points.size(), one.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    EXPECT_EQ(many.points[i].at, one.points[i].at);
    EXPECT_EQ(many.points[i].outward, one.points[i].outward);
  }
}

TEST(SurfaceBorder, OfNothingIsNothing) {
  const SurfaceBorder border = surface_border(ScannedSurface(surface_radius));
  EXPECT_EQ(border.looked_at, 0u);
  EXPECT_TRUE(border.points.empty());
}

}  // namespace
}  // namespace nextview

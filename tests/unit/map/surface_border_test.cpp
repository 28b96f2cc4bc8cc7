#include "core/map/surface_border.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/SVD>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/unit/map/instruction_sets.hpp"

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
  const ScannedSurface surface = surface_of(part_of_sphere(-1.0f));
  EXPECT_GT(surface.cells().size(), 1'500u);
  EXPECT_TRUE(surface_border(surface, 1'000'000).points.empty());
}

TEST(SurfaceBorder, OfHalfASphereIsItsRim) {
  const SurfaceBorder border = surface_border(surface_of(part_of_sphere(0.0f)), 1'000'000);
  // All cells along it.
  EXPECT_NEAR(double(border.points.size()) * border.spacing, 2 * std::numbers::pi * 0.05, 0.05);
  for (const SurfaceBorder::Point& point : border.points) {
    EXPECT_LT(point.at.z(), surface_radius);
    EXPECT_LT(point.outward.z(), -0.7f) << "past the rim, along the surface: " << point.outward.transpose();
    EXPECT_NEAR(point.outward.norm(), 1.0f, 1e-5f);
  }
}

TEST(SurfaceBorder, WithinItIsTheSurfaceWithoutStrayPoints) {
  const ScannedSurface surface = surface_of(part_of_sphere(0.0f));
  const SurfaceBorder border = surface_border(surface, 100);
  std::vector<Eigen::Vector3f> expected;
  for (const ScannedSurface::Cell& cell : surface.cells())
    if (std::popcount(cell.points) >= 4) expected.push_back(float(surface_radius) * cell.middle());
  EXPECT_EQ(border.within, expected);
  EXPECT_LT(border.within.size(), surface.cells().size()) << "the sphere cuts corners off some cells";
  EXPECT_GT(border.within.size(), surface.cells().size() / 2);
}

/// As it is meant to be read: every point is held against every other.
std::vector<Eigen::Vector3f> border_by_brute_force(const ScannedSurface& surface) {
  std::vector<Eigen::Vector3d> points;
  for (const ScannedSurface::Cell& cell : surface.cells()) points.emplace_back(cell.middle().cast<double>());
  std::vector<Eigen::Vector3f> border;
  for (const Eigen::Vector3d& point : points) {
    Eigen::Matrix3Xd ways(3, points.size());
    Eigen::Index count = 0;
    for (const Eigen::Vector3d& other : points)
      if ((other - point).norm() < 2.0) ways.col(count++) = other - point;
    if (count < 6) continue;
    ways.conservativeResize(3, count);
    const Eigen::Vector3d mean = ways.rowwise().mean();
    const Eigen::JacobiSVD<Eigen::Matrix3Xd> axes(ways.colwise() - mean, Eigen::ComputeThinU);
    const Eigen::MatrixXd in_plane = axes.matrixU().leftCols<2>().transpose() * ways;
    bool is_open = (axes.matrixU().leftCols<2>().transpose() * mean).norm() >= 0.3;
    // Open is what has an arc of 2.1 rad without a point: then one begins right past a point.
    bool has_gap = false;
    for (Eigen::Index i = 0; i < count && is_open; ++i) {
      if (ways.col(i).isZero()) continue;
      const double begin = std::atan2(in_plane(1, i), in_plane(0, i));
      double next = 2.0 * std::numbers::pi;
      for (Eigen::Index k = 0; k < count; ++k) {
        if (ways.col(k).isZero()) continue;
        const double on = std::fmod(std::atan2(in_plane(1, k), in_plane(0, k)) - begin + 4.0 * std::numbers::pi,
                                    2.0 * std::numbers::pi);
        if (on > 1e-9) next = std::min(next, on);
      }
      has_gap |= next > 2.1;
    }
    if (is_open && has_gap) border.emplace_back((surface.radius() * point).cast<float>());
  }
  return border;
}

class SurfaceBorderOn : public OnInstructionSet {};
INSTANTIATE_TEST_SUITE_P(InstructionSets, SurfaceBorderOn, instruction_sets(), instruction_set_name);

TEST_P(SurfaceBorderOn, AgreesWithComparingAllPoints) {
  PointCloud points = part_of_sphere(-0.2f);
  std::mt19937 generator(4);
  std::normal_distribution<float> noise(0.0f, 0.0015f);
  std::erase_if(points, [](const Eigen::Vector3f& at) { return (at - Eigen::Vector3f(0.05f, 0, 0)).norm() < 0.02f; });
  for (Eigen::Vector3f& point : points) point *= 1.0f + noise(generator) / point.norm();
  const ScannedSurface surface = surface_of(points);
  const std::vector<Eigen::Vector3f> expected = border_by_brute_force(surface);
  const SurfaceBorder border = surface_border(surface);
  std::size_t found = 0;
  for (const SurfaceBorder::Point& point : border.points)
    found += std::size_t(std::ranges::count_if(
        expected, [&](const Eigen::Vector3f& other) { return (other - point.at).norm() < 1e-5f; }));
  EXPECT_GT(expected.size(), 60u);
  EXPECT_LE(border.points.size(), expected.size() + 1) << "but for rounding";
  EXPECT_GE(found + 1, expected.size()) << "but for rounding";
}

TEST(SurfaceBorder, AFoldIsNone) {
  PointCloud points;
  for (float along = 0.0f; along < 0.1f; along += 0.001f)
    for (float across = 0.0005f; across < 0.1f; across += 0.001f)
      points.emplace_back(along, across, 0.0f), points.emplace_back(along, 0.0f, across);
  const SurfaceBorder border = surface_border(surface_of(points), 1'000'000);
  EXPECT_GT(border.points.size(), 40u) << "the rim is one";
  for (const SurfaceBorder::Point& point : border.points) {
    const Eigen::Vector3f& at = point.at;
    const bool at_the_rim = at.x() < 0.005f || at.x() > 0.095f || std::max(at.y(), at.z()) > 0.095f;
    EXPECT_TRUE(at_the_rim) << at.transpose();
  }
}

TEST(SurfaceBorder, ASampleSaysMuchTheSame) {
  const ScannedSurface surface = surface_of(part_of_sphere(0.0f));
  const SurfaceBorder all = surface_border(surface, 1'000'000), some = surface_border(surface, 250);
  EXPECT_EQ(all.spacing, surface_radius);
  EXPECT_GT(some.spacing, 2 * all.spacing) << "a point stands for as many more as are left out";
  const auto length = [](const SurfaceBorder& border) { return double(border.points.size()) * border.spacing; };
  EXPECT_NEAR(length(some), length(all), 0.25 * length(all));
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
  EXPECT_TRUE(border.points.empty());
}

}  // namespace
}  // namespace nextview

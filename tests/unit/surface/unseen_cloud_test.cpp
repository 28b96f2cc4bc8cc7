// Clouds that nobody knows the cameras of.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numbers>
#include <random>

#include "core/surface/cloud_surface.hpp"
#include "core/surface/normal_orientation.hpp"
#include "tests/unit/surface/surface_checks.hpp"

namespace nextview {
namespace {

constexpr double cloud_radius = 60.0;  // [mm]
const Vector3 middle(10.0, 20.0, 600.0);

/// Points spread at random over a sphere, each off by the noise along its normal; [mm].
PointCloud sphere_cloud(std::size_t count, double noise) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  PointCloud points;
  while (points.size() < count) {
    const Vector3 direction = Vector3(normal(random), normal(random), normal(random)).normalized();
    points.push_back((middle + (cloud_radius + noise * normal(random)) * direction).cast<float>());
  }
  return points;
}

/// The mean distance of the vertices from the sphere.
double mean_distance(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& v : mesh.vertices) sum += std::abs((v.cast<double>() - middle).norm() - cloud_radius);
  return sum / double(mesh.vertices.size());
}

TEST(UnseenCloud, ASphereOfAnyDensityIsClosedAndNearerThanItsPointsLieApart) {
  for (const std::size_t count : {2'000u, 20'000u, 200'000u}) {
    const double spacing = std::sqrt(4.0 * std::numbers::pi * cloud_radius * cloud_radius / double(count));
    const Surface surface = cloud_surface(sphere_cloud(count, 0.05));
    ASSERT_FALSE(surface.empty()) << count << ": " << surface.why_empty;
    EXPECT_TRUE(surface_checks::closed(surface.mesh)) << count;
    EXPECT_EQ(surface_checks::euler_characteristic(surface.mesh), 2) << count;
    EXPECT_LT(mean_distance(surface.mesh), 0.5 * spacing) << count;
    EXPECT_NEAR(surface.mesh.bounding_box().sizes().maxCoeff(), 2.0 * cloud_radius, spacing) << count;
  }
}

TEST(UnseenCloud, NoiseAsLargeAsTheSpacingIsAveraged) {
  const Surface surface = cloud_surface(sphere_cloud(200'000, 0.3));
  ASSERT_FALSE(surface.empty()) << surface.why_empty;
  EXPECT_LT(mean_distance(surface.mesh), 0.15);
}

TEST(UnseenCloud, TheSidesOfAPlateAreTwo) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> across(-50.0f, 50.0f);
  PointCloud points;
  for (int i = 0; i < 40'000; ++i) points.emplace_back(across(random), across(random), i % 2 ? 0.0f : 4.0f);
  const Surface surface = cloud_surface(points);
  ASSERT_FALSE(surface.empty()) << surface.why_empty;
  double upwards = 0.0, right = 0.0;
  for (const auto& t : surface.mesh.triangles) {
    const Eigen::Vector3f a = surface.mesh.vertices[t[0]], b = surface.mesh.vertices[t[1]],
                          c = surface.mesh.vertices[t[2]];
    const Eigen::Vector3f area = (b - a).cross(c - a);
    upwards += std::abs(area.z());
    right += area.z() > 0.0f ? area.z() * (a.z() > 2.0f) : -area.z() * (a.z() < 2.0f);
  }
  EXPECT_NEAR(0.5 * upwards, 2.0 * 100.0 * 100.0, 1000.0) << "twice the plate's area";
  EXPECT_GT(right, 0.99 * upwards) << "all but the rims";
}

TEST(UnseenCloud, NormalsTurnOutOfEachPiece) {
  std::mt19937 random(7);
  PointCloud points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::vector<std::uint32_t>> neighbours;
  for (std::uint32_t i = 0; i < 400; ++i) {  // two rings, each a piece
    const float angle = float(i % 200) * 2.0f * std::numbers::pi_v<float> / 200.0f;
    const Eigen::Vector3f out(std::cos(angle), std::sin(angle), 0.0f);
    points.push_back(out + Eigen::Vector3f(i < 200 ? 0.0f : 5.0f, 0.0f, 0.0f));
    normals.push_back(random() % 2 ? out : Eigen::Vector3f(-out));
    neighbours.push_back({(i + 1) % 200 + i / 200 * 200, (i + 199) % 200 + i / 200 * 200});
  }
  orient_normals(points, neighbours, normals);
  for (std::uint32_t i = 0; i < 400; ++i)
    EXPECT_GT(normals[i].dot(points[i] - Eigen::Vector3f(i < 200 ? 0.0f : 5.0f, 0.0f, 0.0f)), 0.9f) << i;
}

TEST(UnseenCloud, MillionsOfPointsTakeSeconds) {
  const PointCloud points = sphere_cloud(3'000'000, 0.1);
  const auto start = std::chrono::steady_clock::now();
  const Surface surface = cloud_surface(points);
  RecordProperty("seconds",
                 std::to_string(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()));
  ASSERT_FALSE(surface.empty()) << surface.why_empty;
  EXPECT_LT(surface.mesh.triangles.size(), 1'500'000u);
  EXPECT_LT(mean_distance(surface.mesh), 0.05);
}

TEST(UnseenCloud, WhatMakesNoSurfaceSaysWhy) {
  EXPECT_EQ(cloud_surface(PointCloud{}).why_empty, "0 points are too few for a surface");
  EXPECT_EQ(cloud_surface(PointCloud(49, Eigen::Vector3f::Zero())).why_empty, "49 points are too few for a surface");
  EXPECT_EQ(cloud_surface(PointCloud(1000, Eigen::Vector3f::Ones())).why_empty, "all points lie at one place");
  PointCloud line;
  for (int i = 0; i < 1000; ++i) line.emplace_back(float(i), 0.0f, 0.0f);
  cloud_surface(line);  // nothing is promised of it but an end
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(cloud_surface(sphere_cloud(2000, 0.1), {}, stop.get_token()).why_empty, "stopped");
}

TEST(UnseenCloud, TheSameOnAnyNumberOfThreads) {
  const PointCloud points = sphere_cloud(20'000, 0.2);
  const auto make = [&] { return cloud_surface(points); };
  const Surface one = surface_checks::with_threads(1, make), four = surface_checks::with_threads(4, make);
  EXPECT_EQ(one.mesh.vertices, four.mesh.vertices);
  EXPECT_EQ(one.mesh.triangles, four.mesh.triangles);
}

}  // namespace
}  // namespace nextview

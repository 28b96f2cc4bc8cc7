// Aligning a cloud with surfaces of a few planes, where all that it finds can be told by hand.
#include <gtest/gtest.h>

#include "core/progress/stopped.hpp"
#include "core/registration/alignment.hpp"

namespace nextview {
namespace {

void add_rectangle(TriangleMesh& mesh, const Eigen::Vector3f& corner, const Eigen::Vector3f& u,
                   const Eigen::Vector3f& v) {
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const Eigen::Vector3f& at :
       {corner, Eigen::Vector3f(corner + u), Eigen::Vector3f(corner + u + v), Eigen::Vector3f(corner + v)})
    mesh.vertices.push_back(at);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// At z = 0, around the origin.
TriangleMesh plate(float side) {
  TriangleMesh mesh;
  add_rectangle(mesh, {-0.5f * side, -0.5f * side, 0}, {side, 0, 0}, {0, side, 0});
  return mesh;
}

/// `count` x `count` points of a square around the origin, at z = 0.
PointCloud grid_of(int count, float side) {
  PointCloud points;
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < count; ++k)
      points.emplace_back(side * ((float(k) + 0.5f) / float(count) - 0.5f),
                          side * ((float(i) + 0.5f) / float(count) - 0.5f), 0.0f);
  return points;
}

/// Points of a plate, and 40 in pairs above and below it, which pull neither way.
PointCloud with_pairs(float off) {
  PointCloud points = grid_of(21, 1.8f);
  for (int i = 0; i < 20; ++i)
    for (const float z : {off, -off}) points.emplace_back(0.08f * float(i) - 0.76f, 0.31f, z);
  return points;
}

// A fiftieth of the longest side, here 4 cm, is the most that a point may be off.
TEST(AlignSteps, OverlapIsTheShareOfThePointsThatLieNearAndResidualIsTheirs) {
  const TriangleMesh mesh = plate(2.0f);
  const double pairs = 40.0, all = 21.0 * 21.0 + pairs;
  const Alignment near = align(with_pairs(0.03f), mesh), far = align(with_pairs(0.05f), mesh);
  EXPECT_EQ(near.overlap, 1.0);
  EXPECT_NEAR(near.residual, 0.03 * std::sqrt(pairs / all), 1e-6);
  EXPECT_NEAR(far.overlap, 1.0 - pairs / all, 1e-12);
  EXPECT_NEAR(far.residual, 0.0, 1e-6) << "what is not near does not count";
  for (const Alignment& found : {near, far})
    EXPECT_LT((found.T_surface_cloud.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-6) << "it lay there already";
}

// A plate that is 9.5 cm too high, and a narrow rib over it that is as much too high and 7 cm aside: 11 cm off, too far
// for its points to be paired at first. With the plate in place the rib is near enough.
TEST(AlignSteps, WhatComesNearOnTheWayIsPutInPlaceToo) {
  TriangleMesh mesh = plate(1.0f);
  add_rectangle(mesh, {0, -0.2f, 0.5f}, {0, 0.4f, 0}, {0, 0, 0.01f});
  const Eigen::Vector3f shift(0.07f, 0.0f, 0.095f);
  PointCloud cloud;
  const auto add_rib = [&](int first, int last) {  // of 30 points along it
    for (int i = first; i < last; ++i) cloud.emplace_back(0.0f, 0.013f * (float(i) - 14.5f), 0.505f);
  };
  add_rib(0, 15);
  for (const Eigen::Vector3f& p : grid_of(27, 1.0f)) cloud.push_back(p);
  add_rib(15, 30);
  for (Eigen::Vector3f& p : cloud) p += shift;
  const Alignment found = align(cloud, mesh);
  EXPECT_LT((found.T_surface_cloud.translation() + shift.cast<double>()).norm(), 1e-4);
  EXPECT_LT(rotation_angle(found.T_surface_cloud, Pose::Identity()), 1e-4);
  EXPECT_EQ(found.overlap, 1.0);
}

TEST(AlignSteps, AHundredPointsAreEnough) {
  const PointCloud hundred = grid_of(10, 0.5f);
  EXPECT_EQ(align(hundred, plate(1.0f)).overlap, 1.0);
  EXPECT_THROW(align(PointCloud(hundred.begin(), hundred.end() - 1), plate(1.0f)), std::invalid_argument);
}

TEST(AlignSteps, CanBeStopped) {
  std::stop_source stop;
  stop.request_stop();
  const PointCloud there = grid_of(12, 0.5f);
  EXPECT_THROW(align(there, plate(1.0f), stop.get_token()), Stopped);
  PointCloud elsewhere = there;
  for (Eigen::Vector3f& p : elsewhere) p.z() += 5.0f;
  EXPECT_THROW(align(elsewhere, plate(1.0f), stop.get_token()), Stopped) << "while it is searched for";
}

}  // namespace
}  // namespace nextview

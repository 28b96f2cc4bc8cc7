#include "core/evaluation/signed_distance.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/map/ground_truth.hpp"
#include "tests/unit/evaluation/distance_oracle.hpp"
#include "tests/unit/map/closed_meshes.hpp"

namespace nextview {
namespace {

constexpr double radius = 0.1;

TriangleMesh sphere() { return closed_meshes::sphere(Vector3::Zero(), radius, 4); }

std::vector<Eigen::Vector3f> random_points(int count, float reach, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> side(-reach, reach);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) points.emplace_back(side(generator), side(generator), side(generator));
  return points;
}

/// How near the centre the sphere's faces come [m].
double inner_radius(const TriangleMesh& mesh) {
  double nearest = radius;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3 origin = mesh.vertices[a].cast<double>();
    const Vector3 normal =
        (mesh.vertices[b].cast<double>() - origin).cross(mesh.vertices[c].cast<double>() - origin).normalized();
    nearest = std::min(nearest, normal.dot(origin));
  }
  return nearest;
}

/// Points of the sphere's mesh and about it, on the very lines along the axes that lie on vertices and edges.
std::vector<Eigen::Vector3f> points_in_line_with_corners() {
  const TriangleMesh mesh = sphere();
  std::vector<Eigen::Vector3f> places = mesh.vertices;
  for (const auto& [a, b, c] : mesh.triangles) places.push_back(0.5f * (mesh.vertices[a] + mesh.vertices[b]));
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3f& place : places)
    for (int axis = 0; axis < 3; ++axis)
      for (const float height : {-0.13f, -0.05f, 0.0f, 0.02f, 0.11f}) {
        points.push_back(place);
        points.back()[axis] = height;
      }
  return points;
}

TEST(SignedDistance, ofASphereIsThatOfTheBallLessTheFacesDepth) {
  const TriangleMesh mesh = sphere();
  const SignedDistance distance(mesh);
  const double depth = radius - inner_radius(mesh);
  ASSERT_LT(depth, 5e-4);
  for (const Eigen::Vector3f& p : random_points(5000, 0.2f, 1)) {
    const double ball = p.cast<double>().norm() - radius;
    ASSERT_GE(distance(p), ball - 1e-8) << p.transpose();
    ASSERT_LE(distance(p), ball + depth + 1e-8) << p.transpose();
  }
}

TEST(SignedDistance, ofABoxIsExact) {
  const Vector3 half(0.05, 0.08, 0.02), centre(0.013, -0.021, 0.037);
  const SignedDistance distance(closed_meshes::box(centre - half, centre + half));
  for (const Eigen::Vector3f& p : random_points(5000, 0.12f, 2)) {
    const Vector3 beyond = (p.cast<double>() - centre).cwiseAbs() - half;  // of each face
    const double expected = beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
    ASSERT_NEAR(distance(p), expected, 1e-8) << p.transpose();
  }
  EXPECT_EQ(distance((centre + half).cast<float>()), 0.0);
}

TEST(SignedDistance, agreesWithSolidAnglesAndEveryTriangleTriedInTurn) {
  for (const auto& [name, mesh] : closed_meshes::objects()) {
    const SignedDistance distance(mesh);
    for (const Eigen::Vector3f& p : random_points(150, 0.11f, 3))
      ASSERT_NEAR(distance(p), distance_oracle::signed_distance(p.cast<double>(), mesh), 1e-7)
          << name << ", " << p.transpose();
  }
}

TEST(SignedDistance, isInsideWhereTheGroundTruthIs) {
  const VoxelGrid grid = closed_meshes::grid_around_origin();
  for (const auto& [name, mesh] : closed_meshes::objects()) {
    const GroundTruth truth = ground_truth(mesh, grid);
    const SignedDistance distance(mesh);
    for (std::uint32_t i = 0; i < grid.voxel_count(); ++i)
      ASSERT_EQ(distance.inside(grid.centre(i).cast<float>()), truth.centre[i] != 0) << name << ", voxel " << i;
  }
}

TEST(SignedDistance, doesNotMindTurnedTriangles) {
  const TriangleMesh whole = sphere();
  TriangleMesh inside_out = whole, muddled = whole;
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  for (std::size_t t = 0; t < muddled.triangles.size(); t += 3)
    std::swap(muddled.triangles[t][1], muddled.triangles[t][2]);
  const SignedDistance distance(whole), of_inside_out(inside_out), of_muddled(muddled);
  for (const Eigen::Vector3f& p : random_points(3000, 0.15f, 4)) {
    ASSERT_NEAR(of_inside_out(p), distance(p), 1e-12);
    ASSERT_NEAR(of_muddled(p), distance(p), 1e-12);
  }
}

TEST(SignedDistance, doesNotMindASmallHole) {
  const TriangleMesh whole = sphere();
  for (const Vector3& at : {Vector3(1, 0, 0), Vector3(0, 0, -1), Vector3(1, 1, 1), Vector3(0, 1, -1)}) {
    TriangleMesh open = whole;
    const Vector3 middle = radius * at.normalized();
    constexpr double reach = 0.02;
    std::erase_if(open.triangles, [&](const std::array<std::uint32_t, 3>& t) {
      return (whole.vertices[t[0]].cast<double>() - middle).norm() < reach;
    });
    ASSERT_LT(open.triangles.size(), whole.triangles.size());
    const SignedDistance distance(whole), of_open(open);
    for (const Eigen::Vector3f& p : random_points(3000, 0.15f, 5)) {
      if ((p.cast<double>() - middle).norm() < 1.3 * reach) continue;  // in the hole it may be either
      ASSERT_EQ(of_open(p) < 0.0, distance(p) < 0.0) << "hole at " << at.transpose() << ", point " << p.transpose();
    }
  }
}

TEST(SignedDistance, ofABoxWithoutItsLidIsNegativeInTheBox) {
  TriangleMesh open = closed_meshes::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);  // z = 0.1
  const SignedDistance distance(open);
  EXPECT_NEAR(distance({0.01f, 0.02f, -0.07f}), -0.03, 1e-8);
  EXPECT_NEAR(distance({0.01f, 0.02f, 0.09f}), -0.08, 1e-8);
  EXPECT_NEAR(distance({0.01f, 0.02f, -0.14f}), 0.04, 1e-8);
  EXPECT_GT(distance({0.01f, 0.02f, 0.12f}), 0.0);
}

TEST(SignedDistance, isRightExactlyAboveCornersAndEdges) {
  const TriangleMesh mesh = sphere();
  const SignedDistance distance(mesh);
  const double inner = inner_radius(mesh);
  std::size_t inside = 0;
  for (const Eigen::Vector3f& p : points_in_line_with_corners()) {
    const double r = p.cast<double>().norm();
    if (r > inner - 1e-7 && r < radius + 1e-7) continue;
    ASSERT_EQ(distance.inside(p), r < radius) << p.transpose();
    inside += r < radius;
  }
  EXPECT_GT(inside, 1000u);
}

TEST(SignedDistance, isZeroOnTheSurface) {
  const TriangleMesh mesh = sphere();
  const SignedDistance distance(mesh);
  for (const Eigen::Vector3f& vertex : mesh.vertices) ASSERT_NEAR(distance(vertex), 0.0, 1e-12);
  TriangleMesh box = closed_meshes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const SignedDistance of_box(box);
  for (const Eigen::Vector3f& p : random_points(300, 0.5f, 6))
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3f on_face = p;
      on_face[axis] = p[axis] > 0.0f ? 0.5f : -0.5f;
      ASSERT_EQ(of_box(on_face), 0.0);
    }
}

TEST(SignedDistance, needsTriangles) { EXPECT_THROW(SignedDistance{TriangleMesh{}}, std::invalid_argument); }

}  // namespace
}  // namespace nextview

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/map/ground_truth.hpp"
#include "tests/unit/map/closed_meshes.hpp"

namespace nextview {
namespace {

using namespace closed_meshes;

/// The generalised winding number: the sum of the solid angles of all triangles, over 4 pi (van Oosterom and Strackee).
double winding_number(const TriangleMesh& mesh, const Vector3& point) {
  double angle = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.vertices[t[0]].cast<double>() - point, b = mesh.vertices[t[1]].cast<double>() - point,
                  c = mesh.vertices[t[2]].cast<double>() - point;
    const double to_a = a.norm(), to_b = b.norm(), to_c = c.norm();
    angle +=
        2.0 * std::atan2(a.dot(b.cross(c)), to_a * to_b * to_c + a.dot(b) * to_c + b.dot(c) * to_a + c.dot(a) * to_b);
  }
  return angle / (4.0 * std::numbers::pi);
}

TEST(GroundTruthCentre, AgreesWithTheWindingNumberWhateverTheNormals) {
  for (auto& [object, mesh] : objects()) {
    const TriangleMesh oriented = mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    const GroundTruth truth = ground_truth(mesh, grid_around_origin());
    std::size_t inside = 0;
    for (std::uint32_t i = 0; i < truth.grid.voxel_count(); ++i) {
      ASSERT_EQ(bool(truth.centre[i]), std::abs(winding_number(oriented, truth.grid.centre(i))) > 0.5)
          << object << " voxel " << i;
      inside += truth.centre[i];
    }
    EXPECT_TRUE(inside > 100u || std::string(object) == "thin sheet") << object << ' ' << inside;
  }
}

TEST(GroundTruthCentre, AHollowObjectIsHollow) {
  const Vector3 centre(0.0017, 0.0009, -0.0023);
  TriangleMesh mesh = sphere(centre, 0.0963, 3);
  append(mesh, sphere(centre, 0.0561, 3));  // oriented like the outer one: even-odd does not care
  const GroundTruth truth = ground_truth(mesh, grid_around_origin());
  for (std::uint32_t i = 0; i < truth.grid.voxel_count(); ++i) {
    const double radius = (truth.grid.centre(i) - centre).norm();
    if (std::abs(radius - 0.0963) < 0.0015 || std::abs(radius - 0.0561) < 0.0015)
      continue;  // the facets lie below the sphere
    ASSERT_EQ(bool(truth.centre[i]), radius > 0.0561 && radius < 0.0963) << radius;
  }
}

TEST(GroundTruthCentre, ColumnsThroughVerticesAndEdgesDoNotLeak) {
  VoxelGrid grid;
  grid.resolution = 0.125;
  grid.size = {17, 17, 17};
  // Vertices and edges of both lie exactly on columns of voxel centres.
  const Vector3 centre = Vector3::Constant(8.5 * 0.125);
  const GroundTruth diamond = ground_truth(octahedron(centre, 6 * 0.125), grid);
  const GroundTruth cube =
      ground_truth(box(centre - Vector3::Constant(5 * 0.125), centre + Vector3::Constant(5 * 0.125)), grid);
  for (std::uint32_t i = 0; i < grid.voxel_count(); ++i) {
    const Vector3 offset = (grid.centre(i) - centre) / 0.125;
    if (offset.lpNorm<1>() != 6.0) {
      ASSERT_EQ(bool(diamond.centre[i]), offset.lpNorm<1>() < 6.0) << offset.transpose();
    }
    if (offset.lpNorm<Eigen::Infinity>() != 5.0) {
      ASSERT_EQ(bool(cube.centre[i]), offset.lpNorm<Eigen::Infinity>() < 5.0) << offset.transpose();
    }
  }
}

TEST(GroundTruthCentre, RandomClosedMeshesDoNotLeakOutOfTheirBounds) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<float> side(-0.08f, 0.08f);
  const VoxelGrid grid = grid_around_origin();
  for (int round = 0; round < 20; ++round) {
    TriangleMesh mesh = sphere(Vector3::Zero(), 1.0, 2);  // its topology, with vertices thrown anywhere
    for (auto& v : mesh.vertices) v = {side(generator), side(generator), side(generator)};
    const GroundTruth truth = ground_truth(mesh, grid);
    for (std::uint32_t i = 0; i < grid.voxel_count(); ++i)
      if (grid.centre(i).cwiseAbs().maxCoeff() > 0.081) {
        ASSERT_EQ(truth.centre[i], 0) << "round " << round;
      }
  }
}

TEST(GroundTruthCentre, AHoleInOneSideOpensNothingElse) {
  const TriangleMesh closed = box({-0.0613, -0.0427, -0.0771}, {0.0537, 0.0671, 0.0433});
  TriangleMesh open = closed;
  open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 2);  // no bottom
  EXPECT_EQ(ground_truth(open, grid_around_origin()).centre, ground_truth(closed, grid_around_origin()).centre);
}

TEST(GroundTruthCentre, AnOpenSurfaceHasNoInside) {
  TriangleMesh corner = box({-0.0613, -0.0427, -0.0771}, {0.2, 0.2, 0.2});
  corner.triangles = {corner.triangles[0], corner.triangles[1], corner.triangles[4],
                      corner.triangles[5], corner.triangles[8], corner.triangles[9]};  // each column crosses once
  EXPECT_EQ(ground_truth(corner, grid_around_origin()).centre, BitMask(grid_around_origin().voxel_count()));
}

}  // namespace
}  // namespace nextview

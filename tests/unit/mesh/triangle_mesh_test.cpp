#include "core/mesh/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include "tests/unit/mesh/unshared.hpp"

namespace nextview {
namespace {

/// A cube of edge 2 about the origin, normals outwards.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) mesh.vertices.push_back({k & 1 ? 1.f : -1.f, k & 2 ? 1.f : -1.f, k & 4 ? 1.f : -1.f});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(TriangleMesh, boundsAndAreaOfACube) {
  EXPECT_EQ(cube().bounding_box().min(), Eigen::Vector3d(-1, -1, -1));
  EXPECT_EQ(cube().bounding_box().max(), Eigen::Vector3d(1, 1, 1));
  EXPECT_DOUBLE_EQ(cube().surface_area(), 24.0);
  EXPECT_TRUE(TriangleMesh().bounding_box().isEmpty());
  EXPECT_EQ(TriangleMesh().surface_area(), 0.0);
}

TEST(Topology, aClosedCubeIsWatertightWhetherCornersAreSharedOrNot) {
  for (const TriangleMesh& mesh : {cube(), unshared(cube())}) {
    const MeshTopology found = topology(mesh);
    EXPECT_TRUE(found.watertight());
    EXPECT_EQ(found.misoriented_edges, 0u);
    EXPECT_FALSE(found.inward);
    EXPECT_EQ(found.summary(), "watertight");
  }
}

TEST(Topology, zeroAndMinusZeroAreOnePlace) {
  TriangleMesh mesh = unshared(cube());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] += Eigen::Vector3f(1, 1, 1);
    if (i % 2 == 0)
      for (float& x : mesh.vertices[i])
        if (x == 0.f) x = -0.f;
  }
  EXPECT_TRUE(topology(mesh).watertight());
}

TEST(Topology, aMissingTriangleLeavesThreeBoundaryEdges) {
  TriangleMesh mesh = unshared(cube());
  mesh.triangles.pop_back();
  EXPECT_EQ(topology(mesh).boundary_edges, 3u);
  EXPECT_FALSE(topology(mesh).watertight());
  EXPECT_EQ(topology(mesh).summary(), "not watertight: 3 boundary edges");
}

TEST(Topology, aTurnedTriangleHasThreeMisorientedEdges) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  EXPECT_EQ(topology(mesh).misoriented_edges, 3u);
  EXPECT_TRUE(topology(mesh).watertight());
  EXPECT_EQ(topology(mesh).summary(), "watertight: 3 misoriented edges");
}

TEST(Topology, aCubeTurnedInsideOutIsInward) {
  TriangleMesh mesh = cube();
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  // Far from the origin the sign must not drown in rounding.
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex += Eigen::Vector3f(1000, -2000, 3000);
  EXPECT_TRUE(topology(mesh).inward);
  EXPECT_EQ(topology(mesh).misoriented_edges, 0u);
  EXPECT_EQ(topology(mesh).summary(), "watertight: normals point inwards");
}

TEST(Topology, aFinOnACubeMakesOneNonManifoldEdge) {
  TriangleMesh mesh = cube();
  mesh.vertices.push_back({0, -3, -3});
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_EQ(topology(mesh).non_manifold_edges, 1u);
  EXPECT_EQ(topology(mesh).boundary_edges, 2u);
  EXPECT_EQ(topology(mesh).summary(), "not watertight: 2 boundary edges, 1 non-manifold edge");
}

TEST(Topology, aTriangleFoldedToALineChangesNothing) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({0, 1, 1});
  EXPECT_EQ(topology(mesh).summary(), "watertight");
}

}  // namespace
}  // namespace nextview

#include "core/mesh/subdivision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/map/closed_meshes.hpp"
#include "tests/unit/mesh/unshared.hpp"

namespace nextview {
namespace {

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      longest =
          std::max(longest, (mesh.vertices[t[k]].cast<double>() - mesh.vertices[t[(k + 1) % 3]].cast<double>()).norm());
  return longest;
}

/// A closed mesh of long and short, thin and thick triangles: a sphere pulled about.
TriangleMesh crumpled(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> pull(0.1f, 2.0f);
  TriangleMesh mesh = closed_meshes::sphere(Vector3::Zero(), 0.2, 1);
  for (auto& v : mesh.vertices) v = v.cwiseProduct(Eigen::Vector3f(pull(random), pull(random), 3.0f * pull(random)));
  return mesh;
}

TEST(Subdivision, SplitsUntilNoEdgeIsTooLongAndKeepsTheSurface) {
  std::vector<TriangleMesh> meshes = {closed_meshes::box({-0.3, -0.1, -0.02}, {0.2, 0.1, 0.02}),
                                      closed_meshes::torus({0.1, 0.2, 0.3}, 0.3, 0.05, 40, 7)};
  for (unsigned seed = 1; seed <= 5; ++seed) meshes.push_back(crumpled(seed));
  for (const TriangleMesh& mesh : meshes)
    for (const double limit : {0.2, 0.05, 0.013}) {
      for (const TriangleMesh& from : {mesh, unshared(mesh)}) {
        const TriangleMesh fine = subdivided(from, limit);
        EXPECT_LE(longest_edge(fine), limit);
        const MeshTopology found = topology(fine);
        EXPECT_TRUE(found.watertight()) << found.summary();
        EXPECT_EQ(found.misoriented_edges, 0u);
        EXPECT_FALSE(found.inward);
        EXPECT_NEAR(fine.surface_area(), mesh.surface_area(), 1e-4 * mesh.surface_area());
        EXPECT_TRUE(fine.bounding_box().isApprox(mesh.bounding_box()));
        ASSERT_GE(fine.vertices.size(), from.vertices.size());
        EXPECT_TRUE(std::equal(from.vertices.begin(), from.vertices.end(), fine.vertices.begin()));
        // No more than it takes: an edge that was split had been too long, so its halves are over half the limit.
        EXPECT_LT(double(fine.triangles.size()), double(from.triangles.size()) +
                                                     60.0 * mesh.surface_area() / (limit * limit) +
                                                     40.0 * double(from.triangles.size()) * longest_edge(mesh) / limit);
      }
    }
}

TEST(Subdivision, OfATriangleByHand) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(subdivided(mesh, 1.5).triangles, mesh.triangles) << "nothing is too long";
  const TriangleMesh two = subdivided(mesh, 1.0);  // the hypotenuse only
  ASSERT_EQ(two.triangles.size(), 2u);
  ASSERT_EQ(two.vertices.size(), 4u);
  EXPECT_EQ(two.vertices[3], Eigen::Vector3f(0.5f, 0.5f, 0.0f));
  EXPECT_NEAR(two.surface_area(), 0.5, 1e-7);
  const TriangleMesh four = subdivided(mesh, 0.75);  // all three
  EXPECT_EQ(four.triangles.size(), 4u);
  EXPECT_EQ(four.vertices.size(), 6u);
}

// Two of three edges are split, whichever comes first.
TEST(Subdivision, TwoLongEdges) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.9f, 0.5f, 0}};
  for (const std::array<std::uint32_t, 3>& corners :
       {std::array<std::uint32_t, 3>{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}}) {
    mesh.triangles = {corners};
    const TriangleMesh fine = subdivided(mesh, 0.8);
    EXPECT_EQ(fine.triangles.size(), 3u);
    EXPECT_EQ(fine.vertices.size(), 5u);
    EXPECT_NEAR(fine.surface_area(), mesh.surface_area(), 1e-7);
    EXPECT_LE(longest_edge(fine), 0.8);
  }
}

TEST(Subdivision, RefusesWhatNeverEnds) {
  const TriangleMesh box = closed_meshes::box({-1, -1, -1}, {1, 1, 1});
  EXPECT_THROW(subdivided(box, 1e-4), std::invalid_argument);
  for (const double bad : {0.0, -1.0, std::nan("")}) EXPECT_THROW(subdivided(box, bad), std::invalid_argument) << bad;
  EXPECT_EQ(subdivided(box, INFINITY).triangles.size(), box.triangles.size());
  EXPECT_TRUE(subdivided({}, 0.1).triangles.empty());
}

}  // namespace
}  // namespace nextview

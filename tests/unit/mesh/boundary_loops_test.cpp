#include "core/mesh/boundary_loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/mesh/parts.hpp"
#include "tests/unit/map/closed_meshes.hpp"

namespace nextview {
namespace {

/// A flat sheet of unit squares in the z = 0 plane; '#' is there, '.' is missing. The first row is the lowest.
TriangleMesh sheet(const std::vector<std::string>& rows) {
  TriangleMesh mesh;
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < rows[y].size(); ++x) {
      if (rows[y][x] != '#') continue;
      const auto first = std::uint32_t(mesh.vertices.size());
      for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
        mesh.vertices.push_back({float(x) + float(dx), float(y) + float(dy), 0.0f});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  return mesh;
}

std::vector<double> lengths(const TriangleMesh& mesh) {
  std::vector<double> result;
  for (const BoundaryLoop& loop : boundary_loops(mesh)) result.push_back(loop.length);
  return result;
}

TEST(BoundaryLoops, aClosedMeshHasNone) {
  for (const Part& part : {sphere_part(), box_part(), slotted_plate(), slotted_housing()}) {
    EXPECT_TRUE(boundary_loops(part.mesh).empty()) << part.name;
    EXPECT_EQ(summary(boundary_loops(part.mesh)), "watertight");
  }
  EXPECT_TRUE(boundary_loops({}).empty());
}

TEST(BoundaryLoops, aMissingTriangleIsAnOpeningAsLongAsItsSides) {
  TriangleMesh mesh = closed_meshes::box({0.0, 0.0, 0.0}, {0.3, 0.4, 0.5});
  mesh.triangles.erase(mesh.triangles.begin());  // 0.3, 0.4 and 0.5 m long, in the z = 0 plane
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_NEAR(loops[0].length, 1.2, 1e-7);
  // Corners (0, 0), (0, 0.4), (0.3, 0): of gravity of the sides, not of the corners.
  EXPECT_NEAR(loops[0].centre.x(), (0.3 * 0.15 + 0.4 * 0.0 + 0.5 * 0.15) / 1.2, 1e-7);
  EXPECT_NEAR(loops[0].centre.y(), (0.3 * 0.0 + 0.4 * 0.2 + 0.5 * 0.2) / 1.2, 1e-7);
  EXPECT_NEAR(loops[0].centre.z(), 0.0, 1e-12);
  std::vector<std::uint32_t> corners = loops[0].vertices;
  std::sort(corners.begin(), corners.end());
  EXPECT_EQ(corners, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(summary(loops), "1 opening, 1.2 m around, at (100, 150, 0) mm");
}

TEST(BoundaryLoops, ofAPartOfMillimetresStandInMillimetres) {
  TriangleMesh mesh = closed_meshes::box({0.001, 0.0, 0.0}, {0.0013, 0.0004, 0.0005});
  mesh.triangles.erase(mesh.triangles.begin());
  EXPECT_EQ(summary(boundary_loops(mesh)), "1 opening, 1.2 mm around, at (1.1, 0.15, 0) mm");
}

TEST(BoundaryLoops, goAroundInOrder) {
  TriangleMesh sphere = closed_meshes::sphere(Vector3::Zero(), 0.1, 4);
  std::erase_if(sphere.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t i) { return sphere.vertices[i].z() > -1e-6f; });
  });
  const auto loops = boundary_loops(sphere);
  ASSERT_EQ(loops.size(), 1u);  // half a sphere: the equator
  constexpr int corners = 64;   // four octants, divided in two four times
  EXPECT_EQ(loops[0].vertices.size(), std::size_t(corners));
  EXPECT_NEAR(loops[0].length, 0.1 * 2.0 * std::numbers::pi, 0.001);
  EXPECT_NEAR(loops[0].centre.norm(), 0.0, 1e-7);
  for (std::size_t i = 0; i < corners; ++i) {
    const auto from = sphere.vertices[loops[0].vertices[i]], to = sphere.vertices[loops[0].vertices[(i + 1) % corners]];
    EXPECT_LT((to - from).norm(), 0.013f) << "a step over more than one edge";
  }
}

TEST(BoundaryLoops, theLongestComesFirstAndTheSummaryNamesIt) {
  const TriangleMesh mesh = sheet({"######", "#.##.#", "####.#", "######"});
  EXPECT_EQ(lengths(mesh), (std::vector<double>{20.0, 6.0, 4.0}));
  EXPECT_EQ(summary(boundary_loops(mesh)), "3 openings, the longest 20 m around, at (3000, 2000, 0) mm");
  EXPECT_EQ(boundary_loops(mesh)[1].centre, Vector3(4.5, 2.0, 0.0));
}

TEST(BoundaryLoops, thatTouchInACornerStayApart) {
  EXPECT_EQ(lengths(sheet({"#####", "#.###", "##.##", "#####"})), (std::vector<double>{18.0, 4.0, 4.0}));  // holes
  EXPECT_EQ(lengths(sheet({"##..", "##..", "..##", "..##"})), (std::vector<double>{8.0, 8.0}));            // sheets
  EXPECT_EQ(lengths(sheet({"#####", ".###.", "#####"})), (std::vector<double>{20.0}));
  EXPECT_EQ(lengths(sheet({".###", "####", "####"})), (std::vector<double>{14.0}));
  EXPECT_EQ(lengths(sheet({"####", "#..#", "#.#.", "####"})), (std::vector<double>{18.0, 8.0}));  // hole and rim
}

TEST(BoundaryLoops, ofACheckerboardUseEveryEdgeOnceAndNoCornerTwice) {
  std::vector<std::string> rows;
  for (int y = 0; y < 12; ++y) rows.push_back(y % 2 ? "#.#.#.#.#.#." : ".#.#.#.#.#.#");
  const TriangleMesh mesh = sheet(rows);
  const auto loops = boundary_loops(mesh);
  double whole = 0.0;
  for (const BoundaryLoop& loop : loops) {
    whole += loop.length;
    std::vector<std::uint32_t> corners = loop.vertices;
    std::sort(corners.begin(), corners.end());
    EXPECT_EQ(std::adjacent_find(corners.begin(), corners.end()), corners.end());
    EXPECT_GE(corners.size(), 3u);
  }
  EXPECT_EQ(whole, 4.0 * 72.0);
  const auto again = boundary_loops(mesh);
  ASSERT_EQ(again.size(), loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) EXPECT_EQ(again[i].vertices, loops[i].vertices);
}

TEST(BoundaryLoops, ofNonManifoldAndMisorientedMeshes) {
  TriangleMesh box = closed_meshes::box({0, 0, 0}, {1, 1, 1});
  std::swap(box.triangles[4][0], box.triangles[4][1]);
  EXPECT_TRUE(boundary_loops(box).empty()) << "a turned triangle opens nothing";
  box.triangles.push_back({0, 1, 1});
  EXPECT_TRUE(boundary_loops(box).empty()) << "a triangle folded to a line opens nothing";
  box.vertices.push_back({0.0f, -3.0f, -4.0f});
  box.triangles.push_back({0, 1, 8});  // a fin on the edge from (0, 0, 0) to (1, 0, 0)
  EXPECT_EQ(boundary_loops(box).size(), 1u);
  EXPECT_NEAR(lengths(box)[0], 1.0 + 5.0 + std::sqrt(26.0), 1e-6);

  TriangleMesh touching = closed_meshes::box({0, 0, 0}, {1, 1, 1});
  closed_meshes::append(touching, closed_meshes::box({1, 1, 0}, {2, 2, 1}));  // four triangles at the common edge
  EXPECT_TRUE(boundary_loops(touching).empty());
}

}  // namespace
}  // namespace nextview

#include "core/surface/connected_pieces.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/surface/surface_checks.hpp"

namespace nextview {
namespace {

using surface_checks::Triangles;

TriangleMesh with_vertices(std::size_t count, const Triangles& triangles) {
  TriangleMesh mesh;
  for (std::size_t v = 0; v < count; ++v) mesh.vertices.emplace_back(float(v), float(v * v), 1.0f);
  mesh.triangles = triangles;
  return mesh;
}

/// The corners of each triangle by their x, which numbers them.
Triangles corners(const TriangleMesh& mesh) {
  Triangles result;
  for (const auto& [a, b, c] : mesh.triangles)
    result.push_back({std::uint32_t(mesh.vertices[a].x()), std::uint32_t(mesh.vertices[b].x()),
                      std::uint32_t(mesh.vertices[c].x())});
  return result;
}

TEST(ConnectedPieces, OnlyPiecesOfTooFewTrianglesGo) {
  // Three triangles around vertex 0; two over an edge; one alone.
  const Triangles fan = {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}}, pair = {{7, 8, 9}, {9, 8, 10}}, alone = {{11, 12, 13}};
  TriangleMesh mesh = with_vertices(14, {fan[0], pair[0], alone[0], fan[1], pair[1], fan[2]});
  EXPECT_EQ(corners(without_small_pieces(mesh, 0)), mesh.triangles);
  EXPECT_EQ(corners(without_small_pieces(mesh, 1)), mesh.triangles);
  EXPECT_EQ(corners(without_small_pieces(mesh, 2)), (Triangles{fan[0], pair[0], fan[1], pair[1], fan[2]}));
  EXPECT_EQ(corners(without_small_pieces(mesh, 3)), fan);
  EXPECT_EQ(without_small_pieces(mesh, 3).vertices.size(), 7u);
  EXPECT_TRUE(without_small_pieces(mesh, 4).vertices.empty());
  EXPECT_TRUE(without_small_pieces(mesh, 4).triangles.empty());
}

TEST(ConnectedPieces, VerticesThatNoTriangleUsesGo) {
  const TriangleMesh kept = without_small_pieces(with_vertices(9, {{1, 4, 7}}), 1);
  EXPECT_EQ(kept.vertices.size(), 3u);
  EXPECT_EQ(corners(kept), (Triangles{{1, 4, 7}}));
}

TEST(ConnectedPieces, VerticesAreNumberedAsTrianglesUseThem) {
  const TriangleMesh mesh = with_vertices(6, {{5, 3, 4}, {2, 1, 3}});
  const TriangleMesh kept = without_small_pieces(mesh, 1);
  EXPECT_EQ(corners(kept), mesh.triangles);
  EXPECT_EQ(kept.triangles, (Triangles{{0, 1, 2}, {3, 4, 1}}));
}

TEST(ConnectedPieces, NothingOfNothing) {
  EXPECT_TRUE(without_small_pieces({}, 0).vertices.empty());
  EXPECT_TRUE(without_small_pieces({}, 5).triangles.empty());
  EXPECT_TRUE(without_small_pieces(with_vertices(3, {}), 0).vertices.empty());
}

/// Pieces by spreading the least number of a triangle from triangle to triangle until nothing changes.
Triangles kept_by_brute_force(const TriangleMesh& mesh, std::size_t fewest) {
  std::vector<std::size_t> piece(mesh.triangles.size());
  for (std::size_t t = 0; t < piece.size(); ++t) piece[t] = t;
  const auto touch = [&](std::size_t s, std::size_t t) {
    for (const auto a : mesh.triangles[s])
      for (const auto b : mesh.triangles[t])
        if (a == b) return true;
    return false;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t s = 0; s < piece.size(); ++s)
      for (std::size_t t = 0; t < piece.size(); ++t)
        if (piece[t] > piece[s] && touch(s, t)) {
          piece[t] = piece[s];
          changed = true;
        }
  }
  Triangles kept;
  for (std::size_t t = 0; t < piece.size(); ++t)
    if (std::size_t(std::count(piece.begin(), piece.end(), piece[t])) >= fewest) kept.push_back(mesh.triangles[t]);
  return kept;
}

TEST(ConnectedPieces, RandomMeshesAgreeWithBruteForce) {
  std::mt19937 random(4);
  std::size_t removed = 0, left = 0;
  for (int n = 0; n < 300; ++n) {
    const std::uint32_t vertices = 20 + n % 40;
    Triangles triangles;
    for (int t = 0; t < 5 + n % 12; ++t) {
      const auto v = [&] { return std::uint32_t(random() % vertices); };
      triangles.push_back({v(), v(), v()});
    }
    const TriangleMesh mesh = with_vertices(vertices, triangles);
    const std::size_t fewest = n % 6;
    const TriangleMesh kept = without_small_pieces(mesh, fewest);
    ASSERT_TRUE(surface_checks::indices_valid(kept));
    ASSERT_EQ(corners(kept), kept_by_brute_force(mesh, fewest)) << "mesh " << n;
    std::set<std::uint32_t> used;
    for (const auto& t : kept.triangles) used.insert(t.begin(), t.end());
    ASSERT_EQ(used.size(), kept.vertices.size());
    left += kept.triangles.size();
    removed += triangles.size() - kept.triangles.size();
  }
  EXPECT_GT(removed, 300u);
  EXPECT_GT(left, 300u);
}

}  // namespace
}  // namespace nextview

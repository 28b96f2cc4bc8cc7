#include "core/surface/connected_pieces.hpp"

#include <numeric>

namespace nextview {

TriangleMesh without_small_pieces(const TriangleMesh& mesh, std::size_t fewest) {
  // Each vertex points towards the one that stands for its piece.
  std::vector<std::uint32_t> towards(mesh.vertices.size());
  std::iota(towards.begin(), towards.end(), 0u);
  const auto piece_of = [&](std::uint32_t v) {
    while (towards[v] != v) v = towards[v] = towards[towards[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t piece = piece_of(a);
    towards[piece_of(b)] = piece;
    towards[piece_of(c)] = piece;
  }
  std::vector<std::size_t> triangles(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) ++triangles[piece_of(triangle[0])];

  constexpr std::uint32_t unused = -1;
  TriangleMesh kept;
  std::vector<std::uint32_t> number(mesh.vertices.size(), unused);
  for (const auto& triangle : mesh.triangles) {
    if (triangles[piece_of(triangle[0])] < fewest) continue;
    auto& corners = kept.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& n = number[triangle[k]];
      if (n == unused) {
        n = static_cast<std::uint32_t>(kept.vertices.size());
        kept.vertices.push_back(mesh.vertices[triangle[k]]);
      }
      corners[k] = n;
    }
  }
  return kept;
}

}  // namespace nextview

#include "core/mesh/subdivision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace nextview {
namespace {

constexpr std::size_t most_triangles = 4'000'000;
constexpr std::uint32_t whole = 0xffffffffu;  ///< in the place of a middle: the edge is not split

using Triangle = std::array<std::uint32_t, 3>;

std::invalid_argument too_many(double longest_edge) {
  return std::invalid_argument(
      fmt::format("subdivision: edges of at most {} m would take more than {} million triangles", longest_edge,
                  most_triangles / 1'000'000));
}

/// How many triangles there will be at least, of those that have to be split: none of the pieces is larger than one
/// whose edges are all as long as they may be.
double least_pieces(const TriangleMesh& mesh, double longest_edge) {
  const double largest = std::sqrt(3.0) / 4 * longest_edge * longest_edge;  // area [m2]
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d from = mesh.vertices[a].cast<double>();
    const Eigen::Vector3d ab = mesh.vertices[b].cast<double>() - from, ac = mesh.vertices[c].cast<double>() - from;
    if (std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}) > longest_edge * longest_edge)
      area += 0.5 * ab.cross(ac).norm();
  }
  return area / largest;
}

/// One round: every edge that is too long is split in the middle.
class Round {
 public:
  Round(TriangleMesh& mesh, double longest_edge) : mesh_(mesh), longest_squared_(longest_edge * longest_edge) {}

  /// False if nothing was too long.
  bool split() {
    std::vector<Triangle> triangles;
    for (const Triangle& triangle : mesh_.triangles) {
      split(triangle, triangles);
      if (triangles.size() > most_triangles && !middles_.empty()) throw too_many(std::sqrt(longest_squared_));
    }
    mesh_.triangles = std::move(triangles);
    return !middles_.empty();
  }

 private:
  double squared_length(std::uint32_t a, std::uint32_t b) const {
    return (mesh_.vertices[a].cast<double>() - mesh_.vertices[b].cast<double>()).squaredNorm();
  }

  /// Of the edge's ends alone, whichever comes first: the same place in every triangle that has this edge.
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    if (squared_length(a, b) <= longest_squared_) return whole;
    const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [found, is_new] = middles_.try_emplace(edge, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(0.5f * mesh_.vertices[a] + 0.5f * mesh_.vertices[b]);
    return found->second;
  }

  void split(Triangle t, std::vector<Triangle>& into) {
    Triangle m = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    const auto split_edges = 3 - std::count(m.begin(), m.end(), whole);
    // Turned so that the first edges are the ones to split.
    while (split_edges > 0 && split_edges < 3 && (m[0] == whole || m[2] != whole)) {
      std::rotate(t.begin(), t.begin() + 1, t.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    const auto [a, b, c] = t;
    const auto [ab, bc, ca] = m;
    if (split_edges == 0) {
      into.push_back(t);
    } else if (split_edges == 1) {
      into.insert(into.end(), {{a, ab, c}, {ab, b, c}});
    } else if (split_edges == 3) {
      into.insert(into.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    } else if (squared_length(a, bc) <= squared_length(ab, c)) {
      into.insert(into.end(), {{ab, b, bc}, {a, ab, bc}, {a, bc, c}});
    } else {
      into.insert(into.end(), {{ab, b, bc}, {a, ab, c}, {ab, bc, c}});
    }
  }

  TriangleMesh& mesh_;
  double longest_squared_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  ///< vertex in the middle of an edge
};

}  // namespace

TriangleMesh subdivided(const TriangleMesh& mesh, double longest_edge) {
  if (!(longest_edge > 0.0))
    throw std::invalid_argument(fmt::format("subdivision: the longest edge must be over 0 m, not {}", longest_edge));
  // What cannot end is refused before memory is filled; a tenth more, as places are rounded.
  if (least_pieces(mesh, longest_edge) > 1.1 * double(most_triangles)) throw too_many(longest_edge);
  TriangleMesh result = mesh;
  while (Round(result, longest_edge).split()) {
  }
  return result;
}

}  // namespace nextview

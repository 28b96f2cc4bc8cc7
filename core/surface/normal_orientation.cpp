#include "core/surface/normal_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace nextview {
namespace {

/// Two neighbours, and how little their planes agree, from 0 on.
struct Edge {
  float weight;
  std::uint32_t a, b;
  bool operator<(const Edge& other) const { return std::tie(weight, a, b) < std::tie(other.weight, other.a, other.b); }
};

/// Pieces that grow together; of each point whether its normal is turned against that of its piece's root.
class TurnedPieces {
 public:
  explicit TurnedPieces(std::size_t points) : parent_(points), turned_(points, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// The root of a point's piece, and whether the point is turned against it.
  std::pair<std::uint32_t, bool> find(std::uint32_t point) {
    std::uint32_t root = point;
    bool turned = false;
    while (parent_[root] != root) {
      turned ^= turned_[root] != 0;
      root = parent_[root];
    }
    bool left = turned;
    while (parent_[point] != root && point != root) {  // the way is short from now on
      const std::uint32_t next = parent_[point];
      const bool step = turned_[point] != 0;
      parent_[point] = root;
      turned_[point] = left;
      left ^= step;
      point = next;
    }
    return {root, turned};
  }

  void join(std::uint32_t a, std::uint32_t b, bool opposite) {
    const auto [root_a, a_turned] = find(a);
    const auto [root_b, b_turned] = find(b);
    if (root_a == root_b) return;
    parent_[root_b] = root_a;
    turned_[root_b] = a_turned ^ b_turned ^ opposite;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> turned_;
};

/// Neighbours in a plane agree; those that lie along a normal are on the two sides of a thin wall.
std::vector<Edge> edges_of(const std::vector<Eigen::Vector3f>& points,
                           const std::vector<std::vector<std::uint32_t>>& neighbours,
                           const std::vector<Eigen::Vector3f>& normals) {
  std::vector<Edge> edges;
  for (std::uint32_t a = 0; a < points.size(); ++a)
    for (const std::uint32_t b : neighbours[a]) {
      const Eigen::Vector3f way = (points[b] - points[a]).normalized();
      const float across = std::max(std::abs(normals[a].dot(way)), std::abs(normals[b].dot(way)));
      if (a != b) edges.push_back({1.0f - std::abs(normals[a].dot(normals[b])) + across, a, b});
    }
  std::ranges::sort(edges, std::less<>());
  return edges;
}

}  // namespace

void orient_normals(const std::vector<Eigen::Vector3f>& points,
                    const std::vector<std::vector<std::uint32_t>>& neighbours, std::vector<Eigen::Vector3f>& normals) {
  TurnedPieces pieces(points.size());
  for (const Edge& edge : edges_of(points, neighbours, normals))
    pieces.join(edge.a, edge.b, normals[edge.a].dot(normals[edge.b]) < 0.0f);
  std::vector<std::uint32_t> root(points.size()), size(points.size(), 0);
  std::vector<Eigen::Vector3d> middle(points.size(), Eigen::Vector3d::Zero());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto [piece, turned] = pieces.find(i);
    if (turned) normals[i] = -normals[i];
    root[i] = piece;
    middle[piece] += points[i].cast<double>();
    ++size[piece];
  }
  std::vector<double> outwards(points.size(), 0.0);  // of a closed piece, in proportion to its volume
  for (std::uint32_t i = 0; i < points.size(); ++i)
    outwards[root[i]] += normals[i].cast<double>().dot(points[i].cast<double>() - middle[root[i]] / size[root[i]]);
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (outwards[root[i]] < 0.0) normals[i] = -normals[i];
}

}  // namespace nextview

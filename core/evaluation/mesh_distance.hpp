#pragma once
#include <array>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// The distance from points to a mesh's surface, through a tree of bounding boxes. Safe to use from several threads at
/// once.
class MeshDistance {
 public:
  /// @throws std::invalid_argument if the mesh has no triangles.
  explicit MeshDistance(const TriangleMesh& mesh);

  /// Distance from a point [m, world] to the nearest point of any triangle [m], never negative.
  double operator()(const Eigen::Vector3f& point) const;

  /// Calls `visit` with the number in the mesh of every triangle that the line through the point parallel to the axis
  /// may cross.
  template <class Visit>
  void for_each_along(int axis, const Eigen::Vector3f& point, Visit visit) const;

 private:
  using Triangle = std::array<Eigen::Vector3f, 3>;  ///< its corners
  /// An inner node has its first child right behind it and its second at `second`; a leaf has `count` triangles from
  /// `first`.
  struct Node {
    Eigen::Array4f lower, upper;  ///< the bounding box; the last number is 0
    std::uint32_t first = 0, count = 0, second = 0;
  };
  static double squared_distance(const Triangle& triangle, const Vector3& point, double limit);
  void build(const TriangleMesh& mesh, std::size_t begin, std::size_t end);

  std::vector<std::uint32_t> order_;  ///< of each triangle its number in the mesh
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

template <class Visit>
void MeshDistance::for_each_along(int axis, const Eigen::Vector3f& point, Visit visit) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::array<std::uint32_t, 64> stack;  // the tree is less deep than 32
  std::size_t entries = 0;
  stack[entries++] = 0;
  while (entries > 0) {
    const std::uint32_t at = stack[--entries];
    const Node& node = nodes_[at];
    if (point[u] < node.lower[u] || point[u] > node.upper[u] || point[v] < node.lower[v] || point[v] > node.upper[v])
      continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
    if (node.count > 0) continue;
    stack[entries++] = node.second;
    stack[entries++] = at + 1;
  }
}

}  // namespace nextview

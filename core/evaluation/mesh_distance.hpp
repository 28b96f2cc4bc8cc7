#pragma once
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

 private:
  struct Triangle {
    Vector3 a, ab, ac, normal;  ///< a corner, the edges from there, and their cross product
  };
  /// An inner node has its first child right behind it and its second at `second`; a leaf has `count` triangles from
  /// `first`.
  struct Node {
    Eigen::Array4f lower, upper;  ///< the bounding box; the last number is 0
    std::uint32_t first = 0, count = 0, second = 0;
  };
  static double squared_distance(const Triangle& triangle, const Vector3& point, double limit);
  void build(const TriangleMesh& mesh, std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace nextview

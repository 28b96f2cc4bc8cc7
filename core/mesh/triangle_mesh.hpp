#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace nextview {

/// An indexed triangle mesh [m, world]. Every index is valid and every vertex finite; who makes one sees to that.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  Eigen::AlignedBox3d bounding_box() const;
  double surface_area() const;  ///< [m^2]
};

/// How the triangles join. Vertices at the same place count as one.
struct MeshTopology {
  std::size_t boundary_edges = 0;      ///< edges with one triangle
  std::size_t non_manifold_edges = 0;  ///< edges with more than two triangles
  std::size_t misoriented_edges = 0;   ///< edges that both triangles run through in the same direction
  bool inward = false;                 ///< the normals of a closed mesh point inwards (negative signed volume)
  std::size_t left_out = 0;  ///< triangles without an area that a file has; they count above, the mesh is without
  bool watertight() const { return boundary_edges == 0 && non_manifold_edges == 0; }

  /// For people: "watertight", or "not watertight: 12 boundary edges, 3 misoriented edges (1 triangle without an area
  /// left out)".
  std::string summary() const;
};

MeshTopology topology(const TriangleMesh& mesh);

}  // namespace nextview

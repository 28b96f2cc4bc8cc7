#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// A mesh with normals to shade it by: smooth over shallow edges, sharp over steep ones, where a vertex is split into
/// several points.
struct ShadedMesh {
  std::vector<std::uint32_t> vertices;   ///< of the mesh, one a point
  std::vector<Eigen::Vector3f> normals;  ///< one a point, of length 1; 0 if all its triangles have no area
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of points, in the order of the mesh's
};

/// `crease_angle` [deg] between the normals of neighbours: an edge is sharp from there on. On all cores; the same on
/// any number of them.
ShadedMesh shaded(const TriangleMesh& mesh, double crease_angle);

}  // namespace nextview

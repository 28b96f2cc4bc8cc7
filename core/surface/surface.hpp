#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// A reconstructed surface: what a scan says the object looks like.
struct Surface {
  TriangleMesh mesh;  ///< [m, world]; normals point out of the object; each vertex is there once
  /// Of each vertex: how far the surface may lie off along its normal [m]. Who makes the surface says how it is found.
  std::vector<float> uncertainty;
  std::vector<std::uint8_t> seen;  ///< of each vertex, 1: measured; 0: closes the surface where no view has looked

  std::string why_empty;  ///< for people; set if there is no triangle
  bool empty() const { return mesh.triangles.empty(); }
};

}  // namespace nextview

#pragma once
#include <cstdint>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// Every triangle with corners of its own, as STL has them.
inline TriangleMesh unshared(const TriangleMesh& mesh) {
  TriangleMesh copy;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(copy.vertices.size());
    for (const std::uint32_t vertex : triangle) copy.vertices.push_back(mesh.vertices[vertex]);
    copy.triangles.push_back({first, first + 1, first + 2});
  }
  return copy;
}

}  // namespace nextview

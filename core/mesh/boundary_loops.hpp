#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"
#include "core/view/pose.hpp"

namespace nextview {

/// An opening of a mesh: a closed way along its boundary that meets no place twice.
struct BoundaryLoop {
  std::vector<std::uint32_t> vertices;  ///< in order around it; of vertices at the same place the first
  double length = 0.0;                  ///< [m]
  Vector3 centre;                       ///< of gravity of its edges [m, world]
};

/// The openings of a mesh, the longest first; the same mesh always gives the same ones in the same order. Vertices at
/// the same place count as one.
///
/// The boundary are the edges with an odd number of triangles: an even number of them meets in every place, so it falls
/// apart into closed ways without a rest, also where sheets touch or more than two triangles share an edge. Where
/// openings touch in one place they are told apart; where in several, they may share their parts out differently.
std::vector<BoundaryLoop> boundary_loops(const TriangleMesh& mesh);

/// For people: "watertight", or "3 openings, the longest 123 mm around, at (100, 20.5, 310) mm".
std::string summary(std::span<const BoundaryLoop> loops);

}  // namespace nextview

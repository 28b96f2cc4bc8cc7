#pragma once
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// The mesh without its connected pieces of fewer than `fewest` triangles, and without vertices that no triangle uses.
/// Triangles keep their order; vertices are numbered anew, in the order in which triangles use them.
TriangleMesh without_small_pieces(const TriangleMesh& mesh, std::size_t fewest);

}  // namespace nextview

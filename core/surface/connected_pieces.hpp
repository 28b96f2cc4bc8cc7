#pragma once
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// The mesh without its connected pieces of fewer than `fewest` triangles, and without vertices that no triangle uses.
/// What stays keeps its order.
TriangleMesh without_small_pieces(const TriangleMesh& mesh, std::size_t fewest);

}  // namespace nextview

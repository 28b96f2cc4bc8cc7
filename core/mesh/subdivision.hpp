#pragma once
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// The same surface in triangles whose edges are at most `longest_edge` [m] long: longer ones are split in the middle
/// until none is left. An edge splits alike in all of its triangles, also where these have vertices of their own at the
/// same places, so no crack opens. The vertices of `mesh` come first, in their order.
/// @throws std::invalid_argument if `longest_edge` is not over 0, or so small that splitting would make more than 4
///         million triangles.
TriangleMesh subdivided(const TriangleMesh& mesh, double longest_edge);

}  // namespace nextview

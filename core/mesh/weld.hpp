#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// For each vertex a number that vertices at exactly the same place share, counted from 0 in the order of first
/// appearance.
std::vector<std::uint32_t> weld(const std::vector<Eigen::Vector3f>& vertices);

/// The mesh with vertices at the same place joined into the first of them, and without the triangles that this folds to
/// a line or a point.
TriangleMesh welded(const TriangleMesh& mesh);

}  // namespace nextview

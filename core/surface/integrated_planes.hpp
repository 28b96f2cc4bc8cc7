#pragma once
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// How far from the points' box the lattice of integrated_planes reaches [cells].
inline constexpr double integration_margin = 5.0;

/// Where the mean signed distance to the planes of the points around, within two cells, is zero: points of a lattice of
/// cells (Curless and Levoy 1996). It ends where no points are. @pre a normal a point
TriangleMesh integrated_planes(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                               double cell);

}  // namespace nextview

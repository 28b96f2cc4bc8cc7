#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace nextview {

/// Turns the normals of a surface's points, known but for their signs, to one side of it: along the neighbours whose
/// planes agree best (a least spanning tree; Hoppe et al. 1992), and in each connected piece outwards, away from its
/// middle. `neighbours`: of each point, which points lie next to it.
/// @pre one normal, of length 1, and one list of neighbours a point
void orient_normals(const std::vector<Eigen::Vector3f>& points,
                    const std::vector<std::vector<std::uint32_t>>& neighbours, std::vector<Eigen::Vector3f>& normals);

}  // namespace nextview

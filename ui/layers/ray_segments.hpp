#pragma once
#include <vector>

#include "core/gain/view_score.hpp"
#include "ui/layers/rays_layer.hpp"

namespace nextview {

/// At most `count` rays of a score, of each stretch of them the one that contributes most, as a segment to the last
/// voxel it visits, valued by what it contributes.
std::vector<RaySegment> ray_segments(const ScoreExplanation& explanation, const Vector3& origin, double resolution,
                                     std::size_t count = 110);

}  // namespace nextview

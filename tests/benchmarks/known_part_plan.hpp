#pragma once
#include <cstddef>
#include <vector>

#include "core/evaluation/known_object.hpp"

namespace nextview {

/// Candidates in the order in which somebody who knows the part would take them: what all plans are bounded by. A beam
/// search of `views` views from `T_world_start`, where one is taken first, for most coverage after each view, less
/// `way_weight` [1/m] times the way at which a share of the surface is seen. Candidates see what a perfect camera sees.
std::vector<std::size_t> known_part_plan(const KnownObject& part, const Pose& T_world_start, int views,
                                         double way_weight);

}  // namespace nextview

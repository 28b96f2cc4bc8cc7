#pragma once
#include <span>
#include <stop_token>
#include <vector>

#include "core/gain/ray.hpp"
#include "core/planner/knowledge.hpp"

namespace nextview {

/// How much of its scan each view is expected to have in common with those so far, from 0 to 1: the rays that end on
/// measured surface, over the mean of the views taken. It need not say how much new surface is seen beside it. 0 if
/// nothing was scanned. @throws Stopped
std::vector<double> scan_overlap(const Knowledge& known, const RayCaster& caster, const RayBundle& bundle,
                                 std::span<const View> views, const std::stop_token& stop = {});

}  // namespace nextview

#pragma once
#include <span>
#include <vector>

#include "core/gain/new_surface.hpp"
#include "core/planner/set_cover.hpp"

namespace nextview {

/// Few views that together leave no more than `left` [cm^2] of what all views are expected to show, the least set if
/// that is not too hard to find. A view that shows four fifths of what any shows of a part shows that part: rays that
/// fall between others and slants make up the rest, and scans of made-up parts took as many views more.
SetCover covering_views(const NewSurfaceForecast& forecast, double left);

/// How long a short way from `from` by all the stops is [m]: the nearest one next, then turned round wherever that
/// makes it shorter (2-opt). It ends at the last stop.
double short_way(const Vector3& from, std::vector<Vector3> stops);

}  // namespace nextview

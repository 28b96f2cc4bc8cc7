#pragma once
#include "core/map/surface_border.hpp"
#include "core/planner/knowledge.hpp"

namespace nextview {

/// Where what was scanned ends and its surface may go on: beyond its border (SurfaceBorder) the map has not measured
/// free space. Where a thin sheet ends, it has: in the next voxel, or the one after it, as the sheet itself may lie in
/// the next. What a map cannot tell, as it is less than a voxel (the back of a thin wall, a strip in a bore), shows
/// there. Empty if nothing was scanned.
OpenBorder open_border(const Knowledge& known);

}  // namespace nextview

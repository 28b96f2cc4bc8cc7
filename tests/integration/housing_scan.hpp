#pragma once
#include <string>

namespace nextview {

/// A part to scan, as the program is told.
inline std::string housing() { return NEXTVIEW_SOURCE_DIR "/assets/objects/slotted_housing.ply "; }

/// Options of a scan of it that takes a second or two: few pixels, coarse voxels.
inline const std::string coarse_housing =
    "--sensor.width 120 --sensor.height 90 --map.resolution 0.02 --map.region_edge 0.72 --views.count 12 "
    "--evaluation.surface_samples 2000 ";

}  // namespace nextview

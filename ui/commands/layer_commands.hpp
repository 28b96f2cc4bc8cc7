#pragma once
#include "ui/commands/command.hpp"
#include "ui/commands/slice_axis.hpp"

namespace nextview {

// What of a session the scene shows, and in which colours.
namespace command {

extern const CommandOf<> toggle_object, toggle_cloud, toggle_octree, toggle_views, toggle_rays, toggle_region,
    toggle_missed, toggle_surface, toggle_candidates, toggle_legends, edit_region, lock_ranges;
extern const CommandOf<MeshStyle> object_style;
extern const CommandOf<SurfaceSource> surface_source;
extern const CommandOf<SurfaceColouring> surface_colour;
extern const CommandOf<CloudColouring> cloud_colour;

extern const CommandOf<MapChoice> voxel_map;
extern const CommandOf<VoxelColouring> voxel_colour;
extern const CommandOf<> toggle_occupied, toggle_unknown, toggle_free, toggle_uncertain;
extern const CommandOf<double> threshold, uncertain_from;  ///< a probability; an entropy [nats]
extern const CommandOf<SliceAxis> slice_axis;
extern const CommandOf<double, std::optional<double>> slice_at;  ///< its middle, its thickness [m, world]

}  // namespace command
}  // namespace nextview

#pragma once
#include "ui/commands/command.hpp"

namespace nextview {

enum class SliceAxis { none, x, y, z };
enum class StandardView { front, right, back, left, top, bottom, usual };

namespace command {

extern const CommandOf<> lock_ranges;
extern const CommandOf<std::optional<Framed>> frame;
extern const CommandOf<StandardView> standard_view;
extern const CommandOf<double, double> look_from, turn;  ///< azimuth, elevation [deg]
extern const CommandOf<double> zoom;                     ///< steps

extern const CommandOf<> toggle_object, toggle_cloud, toggle_octree, toggle_views, toggle_rays, toggle_region,
    toggle_missed, toggle_candidates, toggle_legends, edit_region;
extern const CommandOf<MeshStyle> object_style;
extern const CommandOf<CloudColouring> cloud_colour;

extern const CommandOf<MapChoice> voxel_map;
extern const CommandOf<VoxelColouring> voxel_colour;
extern const CommandOf<> toggle_occupied, toggle_unknown, toggle_free, toggle_uncertain;
extern const CommandOf<double> threshold, uncertain_from;  ///< a probability; an entropy [nats]
extern const CommandOf<SliceAxis> slice_axis;
extern const CommandOf<double, std::optional<double>> slice_at;  ///< its middle, its thickness [m, world]

}  // namespace command
}  // namespace nextview

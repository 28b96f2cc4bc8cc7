#pragma once
#include "ui/commands/command.hpp"
#include "ui/commands/slice_axis.hpp"

namespace nextview {

enum class StandardView { front, right, back, left, top, bottom, usual };

// Where the scene is looked at from, what of it is cut open, and what stands beside it.
namespace command {

extern const CommandOf<std::optional<Framed>> frame;
extern const CommandOf<StandardView> standard_view;
extern const CommandOf<double, double> look_from, turn;  ///< azimuth, elevation [deg]
extern const CommandOf<double> zoom;                     ///< steps
extern const CommandOf<> toggle_orthographic;
extern const CommandOf<std::string> keep_camera, go_to_camera, remove_camera;  ///< a name
extern const CommandOf<std::optional<SliceAxis>> section_axis;
extern const CommandOf<double> section_at;  ///< [m, world]
extern const CommandOf<> flip_section;
extern const CommandOf<SecondView> second_view;

}  // namespace command
}  // namespace nextview

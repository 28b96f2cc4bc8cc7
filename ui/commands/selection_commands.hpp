#pragma once
#include "ui/commands/command.hpp"

namespace nextview::command {

extern const CommandOf<std::size_t> select_view;   ///< a candidate
extern const CommandOf<std::size_t> select_taken;  ///< a step, from 1
extern const CommandOf<> select_next, look_through, clear_selection;
/// From a point towards another [m, world]; or as the scene is looked at.
extern const CommandOf<std::optional<double>, std::optional<double>, std::optional<double>, std::optional<double>,
                       std::optional<double>, std::optional<double>>
    custom_view;
extern const CommandOf<double, double, double> inspect_voxel;  ///< a point in it [m, world]
extern const CommandOf<std::size_t> inspect_ray;               ///< of the view that is looked at

}  // namespace nextview::command

namespace nextview {

/// custom-view as the scene is looked at, as the same call with its numbers: a script does the same with them, however
/// its window is looked at. Any other call as it is.
CommandCall with_numbers(const CommandCall& call, CommandTarget& target);

}  // namespace nextview

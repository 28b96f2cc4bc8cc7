#pragma once
#include "ui/commands/command.hpp"

namespace nextview::command {

extern const CommandOf<> step, play, go_on, pause, take_proposal, take_custom_view, cancel, undo, redo, reset;
extern const CommandOf<double> speed;                          ///< seconds between two views
extern const CommandOf<std::optional<std::size_t>> take_view;  ///< a candidate; or the selected one

}  // namespace nextview::command

#pragma once
#include "ui/commands/command.hpp"

namespace nextview::command {

extern const CommandOf<std::optional<int>, std::optional<int>> refine;  ///< chains, sweeps; or as the settings say
extern const CommandOf<> pause_refinement, resume_refinement;

}  // namespace nextview::command

#pragma once
#include "ui/commands/command.hpp"

namespace nextview::command {

extern const CommandOf<std::optional<MeasureKind>> measure;    ///< what; none: switches measuring off, or on as it was
extern const CommandOf<double, double, double> measure_point;  ///< x, y, z [m]

}  // namespace nextview::command

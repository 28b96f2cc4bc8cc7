#pragma once
#include "ui/commands/command.hpp"

namespace nextview {

enum class SortOrder { ascending, descending };

namespace command {

extern const CommandOf<std::string> panel;            ///< its name
extern const CommandOf<CurveKind, CurveKind> curves;  ///< of the left and of the right plot
extern const CommandOf<> forget_runs, shortcuts;
extern const CommandOf<CandidateColumn, SortOrder> sort;
extern const CommandOf<std::optional<std::string>> palette;  ///< what it starts with

}  // namespace command
}  // namespace nextview

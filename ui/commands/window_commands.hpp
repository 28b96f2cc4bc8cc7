#pragma once
#include "ui/commands/command.hpp"

namespace nextview {

enum class SortOrder { ascending, descending };
enum class TextSize { smaller, usual, bigger };

namespace command {

extern const CommandOf<std::string> panel;            ///< its name
extern const CommandOf<CurveKind, CurveKind> curves;  ///< of the left and of the right plot
extern const CommandOf<> forget_runs, dismiss, shortcuts, hide_panels, full_screen, guide, dark;
extern const CommandOf<double, double, double> panel_sizes;  ///< left, right, lower [px]
extern const CommandOf<TextSize> text_size;
extern const CommandOf<CandidateColumn, SortOrder> sort;
extern const CommandOf<std::optional<std::string>> palette;  ///< what it starts with
extern const CommandOf<std::optional<std::string>>
    file_dialog;                                            ///< the command that it asks a file for; none: close it
extern const CommandOf<std::optional<std::string>> manual;  ///< a topic; none: the first, or close it

}  // namespace command
}  // namespace nextview

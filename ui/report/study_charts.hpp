#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/study/summary_table.hpp"
#include "ui/report/vector_drawing.hpp"

namespace nextview {

/// A figure of a study's summary.
struct StudyFigure {
  std::string name;
  std::string caption;                                                      ///< what it shows, and how it is read
  std::string needs;                                                        ///< that the study compares
  std::optional<VectorDrawing> (*draw)(const SummaryTable&, const Sheet&);  ///< none: the study has nothing of it
};
std::span<const StudyFigure> study_figures();

/// Seconds a view and stage of each policy, and of each kind of map: the paper's Table 1.
struct TimeTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};
TimeTable time_table(std::span<const TimingRow> timings);
std::string csv_text(const TimeTable& table);
std::string markdown_text(const TimeTable& table);
std::string latex_text(const TimeTable& table);

}  // namespace nextview

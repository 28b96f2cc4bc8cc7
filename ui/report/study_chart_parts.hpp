#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/study/summary_table.hpp"
#include "ui/report/plot.hpp"

namespace nextview {

// What charts of a study have in common.

using StudyChart = std::optional<VectorDrawing>;  ///< none: the study has nothing of it

/// What most methods are compared under.
std::optional<StudySetting> main_setting(const SummaryTable& table, StudyPart part, const std::string& measure);
/// A curve a method, without its points. What plots are often about has a colour of its own, others have those that are
/// left, dashed ones last. Where these do not do for all, what comes with the program is grey, the study's own is not.
std::vector<PlotSeries> curves_of(const std::vector<std::string>& methods);
/// A measure over what it is at, a curve a method; `unit`: that it is shown in.
Plot courses(const SummaryTable& table, const StudySetting& setting, const std::string& measure, double unit = 1.0);
/// "mean of 8 objects, clean"
std::string scope(const SummaryTable& table, const StudySetting& setting, const std::string& measure);
/// Of a chart of curves or dots on this sheet [px].
double chart_width(const Sheet& sheet);
StudyChart one_plot(const Plot& plot, const Sheet& sheet, double height = 460);
StudyChart one_matrix(const MatrixPlot& plot, const Sheet& sheet, double height);
/// A row a method, a column an object, and the mean.
StudyChart by_object(const SummaryTable& table, const Sheet& sheet, const StudySetting& setting,
                     const std::string& measure, MatrixPlot plot, double unit = 1.0);
/// "average_entropy_eq13" as it is read: "average entropy eq13"; "prior_0_5": "prior 0.5"
std::string in_words(std::string name);

// Charts of plans.
StudyChart coverage_by_view(const SummaryTable& table, const Sheet& sheet);
StudyChart coverage_by_path(const SummaryTable& table, const Sheet& sheet);
StudyChart coverage_by_time(const SummaryTable& table, const Sheet& sheet);
StudyChart coverage_by_object(const SummaryTable& table, const Sheet& sheet);
StudyChart entropy_by_view(const SummaryTable& table, const Sheet& sheet);
StudyChart gap_closed(const SummaryTable& table, const Sheet& sheet);
StudyChart predicted_and_seen(const SummaryTable& table, const Sheet& sheet);

// Charts of maps.
StudyChart divergence_by_object(const SummaryTable& table, const Sheet& sheet);
StudyChart log_loss_by_object(const SummaryTable& table, const Sheet& sheet);
StudyChart log_loss_by_sensor(const SummaryTable& table, const Sheet& sheet);
StudyChart openings_by_sensor(const SummaryTable& table, const Sheet& sheet);
StudyChart openings_by_width(const SummaryTable& table, const Sheet& sheet);
StudyChart reliability(const SummaryTable& table, const Sheet& sheet);
StudyChart stationarity(const SummaryTable& table, const Sheet& sheet);

}  // namespace nextview

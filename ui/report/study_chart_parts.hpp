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
StudyChart one_plot(const Plot& plot, const Look& look, double height = 460);
/// A row a method, a column an object, and the mean.
StudyChart by_object(const SummaryTable& table, const Look& look, const StudySetting& setting,
                     const std::string& measure, MatrixPlot plot, double unit = 1.0);
/// "average_entropy_eq13" as it is read: "average entropy eq13"; "prior_0_5": "prior 0.5"
std::string in_words(std::string name);

// Charts of plans.
StudyChart coverage_by_view(const SummaryTable& table, const Look& look);
StudyChart coverage_by_path(const SummaryTable& table, const Look& look);
StudyChart coverage_by_time(const SummaryTable& table, const Look& look);
StudyChart coverage_by_object(const SummaryTable& table, const Look& look);
StudyChart entropy_by_view(const SummaryTable& table, const Look& look);
StudyChart gap_closed(const SummaryTable& table, const Look& look);
StudyChart predicted_and_seen(const SummaryTable& table, const Look& look);

// Charts of maps.
StudyChart divergence_by_object(const SummaryTable& table, const Look& look);
StudyChart log_loss_by_object(const SummaryTable& table, const Look& look);
StudyChart log_loss_by_sensor(const SummaryTable& table, const Look& look);
StudyChart openings_by_sensor(const SummaryTable& table, const Look& look);
StudyChart openings_by_width(const SummaryTable& table, const Look& look);
StudyChart reliability(const SummaryTable& table, const Look& look);
StudyChart stationarity(const SummaryTable& table, const Look& look);

}  // namespace nextview

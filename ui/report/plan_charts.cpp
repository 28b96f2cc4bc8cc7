// Charts of what a study says of plans.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/file/counted.hpp"
#include "ui/report/study_chart_parts.hpp"

namespace nextview {
namespace {

/// Coverage over something that was spent on it.
StudyChart coverage_by(const SummaryTable& table, const Sheet& sheet, const std::string& spent,
                       const std::string& label) {
  const auto setting = main_setting(table, StudyPart::planning, "coverage[%]");
  if (!setting) return std::nullopt;
  Plot plot = courses(table, *setting, "coverage[%]");
  plot.whole_x = false;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const auto methods = table.methods(*setting, "coverage[%]");
    const auto points = table.course(*setting, mean_object, methods[i], spent);
    for (std::size_t k = 0; k < std::min(points.size(), plot.series[i].x.size()); ++k)
      plot.series[i].x[k] = points[k].mean;
    plot.series[i].spread.clear();
  }
  plot.title = "Coverage of the visible surface: " + scope(table, *setting, "coverage[%]");
  plot.x_label = label;
  plot.y_label = "coverage [%]";
  plot.x_low = 0.0;
  plot.y_high = 100.0;
  return one_plot(plot, sheet);
}

}  // namespace

StudyChart coverage_by_view(const SummaryTable& table, const Sheet& sheet) {
  const auto setting = main_setting(table, StudyPart::planning, "coverage[%]");
  if (!setting) return std::nullopt;
  Plot plot = courses(table, *setting, "coverage[%]");
  plot.title = "Coverage of the visible surface: " + scope(table, *setting, "coverage[%]");
  plot.x_label = "views";
  plot.y_label = "coverage [%]";
  plot.y_high = 100.0;
  return one_plot(plot, sheet);
}

StudyChart coverage_by_path(const SummaryTable& table, const Sheet& sheet) {
  return coverage_by(table, sheet, "path[m]", "path of the camera [m]");
}
StudyChart coverage_by_time(const SummaryTable& table, const Sheet& sheet) {
  return coverage_by(table, sheet, "robot_time[s]", "time of moves and scans [s]");
}

/// Under each setting there is: plans, and plans with the Gibbs map in the loop.
StudyChart entropy_by_view(const SummaryTable& table, const Sheet& sheet) {
  const auto settings = table.settings(StudyPart::planning, "entropy[bits]");
  if (settings.empty()) return std::nullopt;
  constexpr double height = 440;
  const double width = chart_width(sheet);
  VectorDrawing drawing(width, height * double(settings.size()), sheet.look);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    Plot plot = courses(table, settings[i], "entropy[bits]", 1e6);
    plot.title = "Unmeasured entropy of the map (Eq. 18): " + scope(table, settings[i], "entropy[bits]");
    plot.x_label = "views";
    plot.y_label = "unmeasured entropy [Mbit]";
    draw_plot(drawing, {0, height * double(i), width, height}, plot);
  }
  return drawing;
}

StudyChart gap_closed(const SummaryTable& table, const Sheet& sheet) {
  const auto setting = main_setting(table, StudyPart::planning, "gap_closed");
  if (!setting) return std::nullopt;
  DotPlot plot;
  plot.title = "Gap closed between random views and the oracle: " + scope(table, *setting, "gap_closed");
  plot.label = "gap closed (0: random views, 1: greedy oracle); bars: spread over objects";
  plot.marks = {{0.0, "random"}, {1.0, "oracle"}};
  for (const std::string& method : table.methods(*setting, "gap_closed")) {
    if (method == "random" || method == "oracle") continue;
    double squares = 0.0, sum = 0.0, count = 0.0;
    for (const std::string& object : table.objects(*setting, "gap_closed"))
      if (const auto closed = table.value(*setting, object, method, "gap_closed"))
        sum += *closed, squares += *closed * *closed, count += 1.0;
    const double variance = count < 2 ? 0.0 : std::max(0.0, (squares - sum * sum / count) / (count - 1.0));
    plot.rows.push_back({in_words(method), table.value(*setting, mean_object, method, "gap_closed").value_or(0.0),
                         std::sqrt(variance), method == "new-surface"});
  }
  std::ranges::stable_sort(plot.rows, std::greater(), &DotPlot::Row::value);
  const double height = 120 + 26.0 * double(plot.rows.size());
  const double width = chart_width(sheet);
  VectorDrawing drawing(width, height, sheet.look);
  draw_dot_plot(drawing, {0, 0, width, height}, plot);
  return drawing;
}

StudyChart coverage_by_object(const SummaryTable& table, const Sheet& sheet) {
  const auto setting = main_setting(table, StudyPart::planning, "mean_coverage[%]");
  if (!setting) return std::nullopt;
  MatrixPlot plot;
  plot.title =
      fmt::format("Mean coverage of the visible surface over {} [%]", counted(std::size_t(setting->views), "view"));
  plot.note = "darker: more";
  return by_object(table, sheet, *setting, "mean_coverage[%]", plot);
}

/// Each object's means, view by view, of every plan that predicts new surface.
StudyChart predicted_and_seen(const SummaryTable& table, const Sheet& sheet) {
  const std::string predicted = "predicted_gain[cm²]", seen = "new_surface[cm²]";
  const auto setting = main_setting(table, StudyPart::planning, predicted);
  if (!setting) return std::nullopt;
  const std::vector<std::string> methods = table.methods(*setting, predicted);
  Plot plot;
  plot.title = methods.size() > 1
                   ? "New surface of a view: predicted, and seen"
                   : fmt::format("New surface of a view: predicted by {}, and seen", in_words(methods.front()));
  plot.x_label = "predicted [cm²]";
  plot.y_label = "seen [cm²]";
  plot.diagonal = true;
  plot.x_low = 0.0;
  plot.series = curves_of(methods);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    PlotSeries& points = plot.series[m];
    points.joined = false;
    if (methods.size() == 1) points.name.clear();  // the title has it
    for (const std::string& object : table.objects(*setting, predicted)) {
      const auto seen_course = table.course(*setting, object, methods[m], seen);
      for (const auto& point : table.course(*setting, object, methods[m], predicted))
        for (const auto& other : seen_course)
          if (other.at == point.at) points.x.push_back(point.mean), points.y.push_back(other.mean);
    }
  }
  return one_plot(plot, sheet, 480);
}

}  // namespace nextview

#include "ui/report/study_chart_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/file/counted.hpp"

namespace nextview {
namespace {

/// A method that its plot is about is drawn in a colour of its own and stronger than the others.
struct Style {
  const char* method;
  std::size_t colour;
  bool strong;
};
constexpr Style styles[] = {{"new-surface", 0, true},
                            {"gibbs", 0, true},
                            {"gibbs_eq13", 0, true},
                            {"random", 4, false},
                            {"paper", 1, true},
                            {"octomap", 1, true},
                            {"calibrated", 2, true},
                            {"average-entropy", 3, false},
                            {"average_entropy_eq13", 3, false}};

}  // namespace

std::string in_words(std::string name) {
  const auto is_digit = [&](std::size_t i) { return i < name.size() && name[i] >= '0' && name[i] <= '9'; };
  for (std::size_t i = 1; i < name.size(); ++i)
    if (name[i] == '_') name[i] = is_digit(i - 1) && is_digit(i + 1) ? '.' : ' ';
  return name;
}

/// What most methods are compared under.
std::optional<StudySetting> main_setting(const SummaryTable& table, StudyPart part, const std::string& measure) {
  const auto all = table.settings(part, measure);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

PlotSeries series_of(const std::vector<SummaryTable::Point>& points, const std::string& method, bool with_spread) {
  PlotSeries series;
  series.name = in_words(method);
  series.colour = theme::muted;
  series.thickness = 1.5;
  for (const Style& style : styles)
    if (method == style.method)
      series.colour = theme::series[style.colour], series.thickness = style.strong ? 2.5 : 2.0;
  if (method == "oracle") series.colour = theme::ink, series.dashed = true;
  for (const auto& point : points) {
    series.x.push_back(point.at);
    series.y.push_back(point.mean);
    if (with_spread && series.thickness > 2.0) series.spread.push_back(point.spread);
  }
  return series;
}

/// A measure over what it is at, a curve a method.
Plot courses(const SummaryTable& table, const StudySetting& setting, const std::string& measure, double unit) {
  Plot plot;
  plot.whole_x = true;
  for (const std::string& method : table.methods(setting, measure)) {
    PlotSeries series = series_of(table.course(setting, mean_object, method, measure), method, true);
    for (double& y : series.y) y /= unit;
    for (double& spread : series.spread) spread /= unit;
    plot.series.push_back(std::move(series));
  }
  return plot;
}

std::string scope(const SummaryTable& table, const StudySetting& setting, const std::string& measure) {
  return fmt::format("mean of {}, {}", counted(table.objects(setting, measure).size(), "object"),
                     in_words(setting.sensor));
}

StudyChart one_plot(const Plot& plot, const Look& look, double height) {
  VectorDrawing drawing(760, height, look);
  draw_plot(drawing, {0, 0, 760, height}, plot);
  return drawing;
}

/// A row a method, a column an object, and the mean.
StudyChart by_object(const SummaryTable& table, const Look& look, const StudySetting& setting,
                     const std::string& measure, MatrixPlot plot, double unit) {
  std::vector<std::string> objects = table.objects(setting, measure);
  objects.emplace_back(mean_object);
  for (const std::string& object : objects) plot.columns.push_back(object == mean_object ? "mean" : in_words(object));
  for (const std::string& method : table.methods(setting, measure)) {
    plot.rows.push_back(in_words(method));
    auto& row = plot.values.emplace_back();
    for (const std::string& object : objects) {
      const auto value = table.value(setting, object, method, measure);
      row.push_back(value ? std::optional(*value / unit) : std::nullopt);
    }
  }
  const double height = 120 + 28.0 * double(plot.rows.size());
  VectorDrawing drawing(860, height, look);
  draw_matrix(drawing, {0, 0, 860, height}, plot);
  return drawing;
}

}  // namespace nextview

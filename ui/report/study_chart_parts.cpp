#include "ui/report/study_chart_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "core/file/counted.hpp"
#include "core/planner/policy.hpp"

namespace nextview {
namespace {

/// A method that plots are often about has a colour of its own, and may be stronger than the others. Of those that
/// share a colour the first has it.
struct Style {
  std::string_view method;
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

const Style* style_of(const std::string& method) {
  const auto found = std::ranges::find(styles, std::string_view(method), &Style::method);
  return found == std::end(styles) ? nullptr : found;
}

/// Which has this colour where several would.
const Style* first_of(std::size_t colour, const std::vector<std::string>& methods) {
  return std::ranges::find_if(styles, [&](const Style& style) {
    return style.colour == colour && std::ranges::count(methods, style.method) > 0;
  });
}

bool comes_with_the_program(const std::string& method) { return std::ranges::count(policy_names(), method) > 0; }

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

std::vector<PlotSeries> curves_of(const std::vector<std::string>& methods) {
  std::vector<PlotSeries> curves;
  std::vector<std::size_t> others;                 // that have no colour yet
  std::vector<std::pair<std::size_t, bool>> left;  // colours, and whether they are dashed
  for (const bool dashed : {false, true})
    for (std::size_t colour = 0; colour < theme::series.size(); ++colour) left.emplace_back(colour, dashed);
  for (const std::string& method : methods) {
    PlotSeries& curve = curves.emplace_back();
    curve.name = in_words(method);
    const Style* style = style_of(method);
    curve.thickness = !style ? 1.5 : style->strong ? 2.5 : 2.0;
    if (method == "oracle")
      curve.colour = theme::ink, curve.dashed = true;
    else if (style && first_of(style->colour, methods) == style)
      curve.colour = theme::series[style->colour], std::erase(left, std::pair(style->colour, false));
    else
      curve.colour = theme::muted, others.push_back(curves.size() - 1);
  }
  if (others.size() > left.size()) std::erase_if(others, [&](auto i) { return comes_with_the_program(methods[i]); });
  for (std::size_t i = 0; i < std::min(others.size(), left.size()); ++i) {
    PlotSeries& curve = curves[others[i]];
    curve.colour = theme::series[left[i].first];
    curve.dashed = left[i].second;
    curve.thickness = std::max(curve.thickness, 2.0);
  }
  return curves;
}

/// A measure over what it is at, a curve a method.
Plot courses(const SummaryTable& table, const StudySetting& setting, const std::string& measure, double unit) {
  constexpr std::size_t most_bands =
      4;  // that can be told apart; where there are more curves, the strong ones have them
  const std::vector<std::string> methods = table.methods(setting, measure);
  Plot plot;
  plot.whole_x = true;
  plot.series = curves_of(methods);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    PlotSeries& series = plot.series[i];
    for (const auto& point : table.course(setting, mean_object, methods[i], measure)) {
      series.x.push_back(point.at);
      series.y.push_back(point.mean / unit);
      if (methods.size() <= most_bands || series.thickness > 2.0) series.spread.push_back(point.spread / unit);
    }
  }
  return plot;
}

std::string scope(const SummaryTable& table, const StudySetting& setting, const std::string& measure) {
  return fmt::format("mean of {}, {}", counted(table.objects(setting, measure).size(), "object"),
                     in_words(setting.sensor));
}

StudyChart one_plot(const Plot& plot, const Sheet& sheet, double height) {
  const double width = chart_width(sheet);
  VectorDrawing drawing(width, height, sheet.look);
  draw_plot(drawing, {0, 0, width, height}, plot);
  return drawing;
}

/// A row a method, a column an object, and the mean.
StudyChart by_object(const SummaryTable& table, const Sheet& sheet, const StudySetting& setting,
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
  return one_matrix(plot, sheet, height);
}

StudyChart one_matrix(const MatrixPlot& plot, const Sheet& sheet, double height) {
  constexpr double usual = 860;
  const double width = std::clamp(sheet.width, std::min(usual, least_width(plot)), usual);
  VectorDrawing drawing(width, height, sheet.look);
  draw_matrix(drawing, {0, 0, width, height}, plot);
  return drawing;
}

double chart_width(const Sheet& sheet) {
  constexpr double usual = 760, least = 320;
  return std::clamp(sheet.width, least, usual);
}

}  // namespace nextview

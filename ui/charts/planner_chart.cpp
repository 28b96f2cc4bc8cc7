#include "ui/charts/planner_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "core/file/read_file.hpp"
#include "ui/appearance/colour_map.hpp"
#include "ui/charts/curve_plot.hpp"

namespace nextview {
namespace {

/// How a policy is shown. Colours differ in lightness too, and beside the plot the names stand in the curves' order.
struct Style {
  std::string policy, name;
  Colour colour;
  bool each_object;  ///< it is drawn for each of them
};

const std::vector<Style>& known_styles() {
  static const std::vector<Style> all = {
      {"default", "expected new surface (default)", theme::series[0], true},
      {"oracle", "greedy oracle, knows the mesh", theme::ink, true},
      {"set-cover", "least set cover, knows the mesh", mix(theme::ink, theme::paper, 0.55), false},
      {"random", "random views (mean of seeds)", theme::series[4], true},
      {"paper", "the paper's plan", theme::series[1], true},
      {"surface-edge-density", "surface edge density", theme::series[2], false},
      {"proximity-count", "proximity count", theme::series[3], false},
      {"average-entropy", "average entropy", mix(theme::series[3], theme::paper, 0.5), false},
      {"area-factor", "area factor", mix(theme::series[2], theme::paper, 0.55), false},
  };
  return all;
}

/// Of the policies that there are, in the order above; others follow, in colours that are left.
std::vector<Style> styles_of(const std::vector<PlannerCourse>& courses) {
  std::vector<Style> styles;
  for (const Style& style : known_styles())
    if (std::ranges::count(courses, style.policy, &PlannerCourse::policy) > 0) styles.push_back(style);
  std::vector<Colour> left;
  for (const double pale : {0.0, 0.5})
    for (const Colour& colour : theme::series)
      if (const Colour one = mix(colour, theme::paper, pale); std::ranges::count(styles, one, &Style::colour) == 0)
        left.push_back(one);
  std::size_t others = 0;
  for (const PlannerCourse& course : courses)
    if (std::ranges::count(styles, course.policy, &Style::policy) == 0)
      styles.push_back({course.policy, course.policy, left[others++ % left.size()], true});
  return styles;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

bool is_view_number(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

double number_of(const std::string& text) {
  double value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : NAN;
}

double mean(const PlannerCourse& course) {
  return std::accumulate(course.coverage.begin(), course.coverage.end(), 0.0) / double(course.coverage.size());
}

/// Of each policy over the objects, as many views as all have.
std::vector<PlannerCourse> means_of(const std::vector<PlannerCourse>& courses) {
  std::vector<PlannerCourse> means;
  std::vector<int> counts;
  for (const PlannerCourse& course : courses) {
    auto mean = std::ranges::find(means, course.policy, &PlannerCourse::policy);
    if (mean == means.end()) {
      means.push_back({"", course.policy, std::vector<double>(course.coverage.size())});
      counts.push_back(0);
      mean = means.end() - 1;
    }
    ++counts[std::size_t(mean - means.begin())];
    mean->coverage.resize(std::min(mean->coverage.size(), course.coverage.size()));
    for (std::size_t i = 0; i < mean->coverage.size(); ++i) mean->coverage[i] += course.coverage[i];
  }
  for (std::size_t m = 0; m < means.size(); ++m)
    for (double& coverage : means[m].coverage) coverage /= counts[m];
  return means;
}

/// Of one object, in the order of the file.
std::vector<PlannerCourse> courses_of(const std::vector<PlannerCourse>& courses, const std::string& object) {
  std::vector<PlannerCourse> some;
  std::ranges::copy_if(courses, std::back_inserter(some), [&](const auto& c) { return c.object == object; });
  return some;
}

Curve curve_of(const PlannerCourse& course, const Style& style) {
  Curve curve;
  curve.colour = style.colour;
  curve.y = course.coverage;
  curve.x.resize(curve.y.size());
  std::iota(curve.x.begin(), curve.x.end(), 1.0);
  return curve;
}

/// What is drawn of each object.
std::string each_object_text(const std::vector<Style>& styles) {
  std::string names;
  for (const Style& style : styles)
    if (style.each_object) names += (names.empty() ? "" : "; ") + style.name;
  return fmt::format("Of each object, in the colours of the mean: {}.", names);
}

CurvePlot empty_plot(const std::vector<PlannerCourse>& courses, const std::string& title) {
  CurvePlot plot;
  plot.title = title;
  plot.x_label = "views";
  plot.y_label = "coverage [%]";
  plot.whole_x = true;
  plot.x_low = 1.0, plot.x_high = 2.0;
  plot.y_low = 100.0, plot.y_high = 100.5;
  for (const PlannerCourse& course : courses) {
    plot.x_high = std::max(plot.x_high, double(course.coverage.size()));
    plot.y_low = std::min(plot.y_low, 10.0 * std::floor(0.1 * std::ranges::min(course.coverage)));
  }
  return plot;
}

CurvePlot mean_plot(std::vector<PlannerCourse> courses, const std::vector<Style>& styles, std::size_t objects) {
  CurvePlot plot = empty_plot(courses, fmt::format("Mean of {} objects", objects));
  plot.names_width = 268;
  std::ranges::stable_sort(courses, std::greater(), [](const PlannerCourse& c) { return mean(c); });
  for (const PlannerCourse& course : courses) {
    const Style& style = *std::ranges::find(styles, course.policy, &Style::policy);
    Curve curve = curve_of(course, style);
    curve.name = style.name;
    curve.details = {fmt::format("{:.1f} % on average", mean(course))};
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

CurvePlot object_plot(const std::vector<PlannerCourse>& courses, const std::vector<Style>& styles, double y_low) {
  CurvePlot plot = empty_plot(courses, courses.front().object);
  std::ranges::replace(plot.title, '_', ' ');
  plot.y_low = y_low;
  for (const Style& style : styles) {
    const auto course = std::ranges::find(courses, style.policy, &PlannerCourse::policy);
    if (style.each_object && course != courses.end()) plot.curves.push_back(curve_of(*course, style));
  }
  std::ranges::reverse(plot.curves);  // the default is drawn above the others
  return plot;
}

}  // namespace

std::vector<PlannerCourse> read_planner_courses(const std::filesystem::path& file) {
  std::istringstream in(read_file(file));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = cells_of(line);
  if (header.size() < 3 || header[0] != "object" || header[1] != "policy" || !is_view_number(header.back()))
    throw std::runtime_error(fmt::format("{}: no table of planner_comparison", file.string()));
  std::vector<PlannerCourse> courses;
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const std::vector<std::string> cells = cells_of(line);
    PlannerCourse course;
    for (std::size_t i = 0; i < cells.size() && i < header.size(); ++i)
      if (is_view_number(header[i])) course.coverage.push_back(number_of(cells[i]));
    if (cells.size() != header.size() ||
        !std::ranges::all_of(course.coverage, [](double c) { return c >= 0 && c <= 100; }))
      throw std::runtime_error(fmt::format("{}:{}: not a row of the table", file.string(), number));
    course.object = cells[0], course.policy = cells[1];
    if (course.object != "mean") courses.push_back(std::move(course));  // it is made again
  }
  return courses;
}

Image draw_planner_chart(const std::vector<PlannerCourse>& courses, int width, int height) {
  if (courses.empty()) throw std::invalid_argument("planner chart: there is no course");
  std::vector<std::string> objects;
  for (const PlannerCourse& course : courses)
    if (std::ranges::find(objects, course.object) == objects.end()) objects.push_back(course.object);
  const double y_low = empty_plot(courses, "").y_low;
  const std::vector<Style> styles = styles_of(courses);
  return draw_page(width, height, [&](vtkContext2D& context) {
    Painter painter(context);
    const double top = height - paint_title(painter, width, height, "Coverage of the visible surface against views", "",
                                            each_object_text(styles));
    constexpr int columns = 6;
    constexpr double object_height = 236;
    const int rows = (int(objects.size()) + columns - 1) / columns;
    const double bottom = page_margin + rows * (object_height + page_margin);
    paint_curve_plot(context, {page_margin, bottom, width - 2 * page_margin, top - bottom},
                     mean_plot(means_of(courses), styles, objects.size()));
    const double object_width = (width - (columns + 1) * page_margin) / columns;
    for (int i = 0; i < int(objects.size()); ++i)
      paint_curve_plot(context,
                       {page_margin + i % columns * (object_width + page_margin),
                        bottom - (i / columns + 1) * (object_height + page_margin), object_width, object_height},
                       object_plot(courses_of(courses, objects[std::size_t(i)]), styles, y_low));
  });
}

}  // namespace nextview

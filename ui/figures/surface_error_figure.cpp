#include "ui/figures/surface_error_figure.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/setting/percent_text.hpp"
#include "core/surface/seen_part.hpp"
#include "ui/charts/curve_plot.hpp"
#include "ui/figures/surface_views.hpp"
#include "ui/figures/uncertainty_spread.hpp"

namespace nextview {
namespace {

constexpr double table_row = 28.0;  // of a table [px]
constexpr double per_mm = 1e3;

/// One large view and two small ones beneath it, beside them a chart above numbers.
struct SurfaceErrorLayout {
  PageArea large, left, right, chart, numbers;

  SurfaceErrorLayout(RenderTarget& target, const SurfacePicture& picture, double share_of_numbers) {
    const int page_width = target.width(), page_height = target.height();
    double top = page_height;
    // What the title needs, only a page can tell; one of any size.
    draw_page(target, {smallest_picture, smallest_picture}, [&](vtkContext2D& context) {
      Painter painter(context);
      top -= paint_title(painter, page_width, page_height, picture.title, picture.remark, picture.caption);
    });
    const double column = std::floor((page_width - 4 * page_margin) / 3), second = 2 * page_margin + column,
                 third = second + column + page_margin;
    const double both = top - 3 * page_margin, small = std::floor(0.4 * both),
                 sums = std::floor(share_of_numbers * both);
    large = {page_margin, 2 * page_margin + small, 2 * column + page_margin, both - small};
    left = {page_margin, page_margin, column, small};
    right = {second, page_margin, column, small};
    numbers = {third, page_margin, column, sums};
    chart = {third, 2 * page_margin + sums, column, both - sums};
  }
};

std::vector<float> in_mm(const std::vector<float>& metres) {
  std::vector<float> result;
  for (const float value : metres) result.push_back(float(per_mm * value));
  return result;
}

/// Of millimetres, with three significant digits: "0.120", "12.0", "120".
std::string digits(double metres) {
  const double value = per_mm * metres;
  return value < 99.95 ? fmt::format("{:#.3g}", value) : fmt::format("{:.0f}", value);
}
std::string mm(double metres) { return digits(metres) + " mm"; }
std::string signed_mm(double metres) { return (metres < 0.0 ? "−" : "+") + mm(std::abs(metres)); }
/// Nothing but the whole is called 100 %.
std::string percent(double share) {
  if (std::isnan(share)) return "–";
  return share < 1.0 && share > 0.9995 ? "> 99.9 %" : fmt::format("{:.1f} %", 1e2 * share);
}

struct Number {
  std::string label, value;
};

/// Downwards from `y`; returns where it ends.
double paint_numbers(Painter& painter, const PageArea& panel, double y, const std::vector<Number>& numbers) {
  const double left = panel.left + page_margin, right = panel.right() - page_margin;
  for (const Number& number : numbers) {
    y -= table_row;
    painter.line(left, y + table_row - 7, right, y + table_row - 7, 1, theme::hairline);
    painter.text(left, y, number.label, theme::small_text, theme::ink);
    painter.text(right, y, number.value, theme::small_text, theme::ink, TextWeight::semi_bold, TextAlign::right);
  }
  return y;
}

/// A row per threshold; returns where it ends.
double paint_scores(Painter& painter, const PageArea& panel, double y, const std::vector<ThresholdScore>& scores) {
  const double left = panel.left + page_margin, right = panel.right() - page_margin;
  const double column = (right - left - 70) / 4;
  const auto cell = [&](int i, const std::string& text, const Colour& colour, TextWeight weight) {
    painter.text(left + 70 + (i + 1) * column, y, text, theme::small_text, colour, weight, TextAlign::right);
  };
  y -= 18;
  const auto heading = [&](int i, const std::string& text) { cell(i, text, theme::soft_ink, TextWeight::regular); };
  painter.text(left, y, "within", theme::small_text, theme::soft_ink);
  heading(0, "accuracy");
  heading(1, "completeness");
  heading(2, "… of all");
  heading(3, "F-score");
  for (const ThresholdScore& score : scores) {
    y -= table_row;
    painter.line(left, y + table_row - 7, right, y + table_row - 7, 1, theme::hairline);
    painter.text(left, y, fmt::format("{:g} mm", per_mm * score.threshold), theme::small_text, theme::ink);
    cell(0, percent(score.accuracy), theme::ink, TextWeight::semi_bold);
    cell(1, percent(score.completeness_visible), theme::ink, TextWeight::semi_bold);
    cell(2, percent(score.completeness_all), theme::ink, TextWeight::regular);
    cell(3, percent(score.f_score), theme::ink, TextWeight::regular);
  }
  return y;
}

void paint_note(Painter& painter, const PageArea& panel, const std::string& note) {
  const auto lines = wrapped(painter, note, panel.width - 2 * page_margin, theme::small_text);
  for (std::size_t i = 0; i < lines.size(); ++i)
    painter.text(panel.left + page_margin, panel.bottom + 14 + 18.0 * double(lines.size() - 1 - i), lines[i],
                 theme::small_text, theme::soft_ink);
}

/// Bars from `low` to `high` [mm], coloured as on the surface.
CurvePlot histogram_plot(const std::string& title, const std::string& x_label, double low, double high,
                         const std::vector<double>& shares, const ColourMap& map) {
  CurvePlot plot;
  plot.title = title;
  plot.x_label = x_label;
  plot.y_label = "share of the seen area [%]";
  plot.x_low = low;
  plot.x_high = high;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double width = (high - low) / double(shares.size()), from = low + width * double(i);
    plot.bars.push_back({from, from + width, 1e2 * shares[i], map.at(from + 0.5 * width, low, high)});
  }
  const double most = shares.empty() ? 0.0 : *std::max_element(shares.begin(), shares.end());
  plot.y_high = most > 0.0 ? 1.1e2 * most : 1.0;
  return plot;
}

/// A line from the axis to the top [m].
Curve upright(const std::string& name, double at, const CurvePlot& plot, const Colour& colour) {
  return {name, {}, {per_mm * at, per_mm * at}, {plot.y_low, plot.y_high}, colour};
}

CurvePlot distance_plot(const SurfaceError& error) {
  const DistanceHistogram& histogram = error.histogram;
  std::size_t samples = histogram.below + histogram.above;
  for (const std::size_t count : histogram.counts) samples += count;
  std::vector<double> shares;
  for (const std::size_t count : histogram.counts) shares.push_back(double(count) / double(samples));
  const double limit = per_mm * histogram.limit;
  CurvePlot plot = histogram_plot("How the distances are spread", "signed distance [mm]", -limit, limit, shares,
                                  ColourMap::deviation());
  if (const std::size_t beyond = histogram.below + histogram.above; beyond > 0)
    plot.remark = percent_text(double(beyond) / double(samples)) + " lie farther off";
  plot.curves = {upright("mean " + signed_mm(error.bias), error.bias, plot, theme::ink),
                 upright("95 % within ±" + mm(error.percentile_95), error.percentile_95, plot, theme::series[3]),
                 upright("", -error.percentile_95, plot, theme::series[3])};
  return plot;
}

std::string seen_share(double seen, double unseen) {
  const SeenArea area{seen, unseen};
  return fmt::format("{} seen, {} not", area.text(seen), area.text(unseen));
}

/// How many there are stands where other numbers have their names.
Number openings_number(const std::string& openings) {
  const auto comma = openings.find(", ");
  if (comma == std::string::npos) return {"openings", openings};
  return {openings.substr(0, comma), openings.substr(comma + 2)};
}

void paint_surface_error(Painter& painter, const PageArea& panel, const SurfacePicture& picture,
                         const SurfaceError& i) {
  paint_panel(painter, panel, "Accuracy and completeness");
  double y = paint_scores(painter, panel, panel.top() - heading_height, i.scores) - 14;
  paint_numbers(painter, panel, y,
                {{"mean (bias), root mean square", signed_mm(i.bias) + ", " + mm(i.rms)},
                 {"50th, 95th, 99th percentile",
                  digits(i.percentile_50) + ", " + digits(i.percentile_95) + ", " + mm(i.percentile_99)},
                 {"area", seen_share(i.area_seen, i.area_unseen)},
                 openings_number(picture.openings)});
  paint_note(painter, panel,
             "Accuracy: share of the seen surface that lies within so much of the true one. Completeness: share of the "
             "true surface that some view could see, and of all of it, within so much of the seen one.");
}

CurvePlot uncertainty_plot(const UncertaintySpread& spread) {
  CurvePlot plot = histogram_plot("How the uncertainty is spread", "uncertainty [mm]", 0.0, per_mm * spread.end,
                                  spread.shares, ColourMap::contribution());
  plot.curves = {upright("median " + mm(spread.median), spread.median, plot, theme::ink),
                 upright("95 % at most " + mm(spread.percentile_95), spread.percentile_95, plot, theme::series[3])};
  return plot;
}

void paint_uncertainty(Painter& painter, const PageArea& panel, const SurfacePicture& picture,
                       const UncertaintySpread& spread) {
  const Surface& surface = *picture.surface;
  paint_panel(painter, panel, "The surface");
  paint_numbers(
      painter, panel, panel.top() - heading_height + 7,
      {{"area", seen_share(spread.area_seen, spread.area_unseen)},
       {"uncertainty, median and 95th percentile", mm(spread.median) + ", " + mm(spread.percentile_95)},
       {"vertices, triangles", fmt::format("{}, {}", surface.mesh.vertices.size(), surface.mesh.triangles.size())},
       openings_number(picture.openings)});
  paint_note(painter, panel,
             "Seen: triangles whose three corners were measured. What is not seen closes the surface where no view has "
             "looked; it has no uncertainty that means anything.");
}

const Surface& surface_of(const SurfacePicture& picture, std::size_t values) {
  if (!picture.surface) throw std::invalid_argument("surface figure: there is no surface");
  const std::size_t vertices = picture.surface->mesh.vertices.size();
  if (values != vertices || picture.surface->seen.size() != vertices)
    throw std::invalid_argument(fmt::format("surface figure: {} vertices, but {} values and {} marks of seen", vertices,
                                            values, picture.surface->seen.size()));
  return *picture.surface;
}

}  // namespace

Image draw_surface_error_figure(RenderTarget& target, const SurfacePicture& picture, const SurfaceError& error) {
  const Surface& surface = surface_of(picture, error.at_vertices.size());
  const std::vector<float> values = in_mm(error.at_vertices);
  const double limit = per_mm * error.histogram.limit;
  const MeshPaint paint{values,   surface.seen, ColourMap::deviation(), -limit, limit, "signed distance", "mm",
                        "inside", "outside"};
  const SurfaceErrorLayout layout(target, picture, 0.56);
  const SurfaceViews views(target, surface.mesh, paint, "How far it lies from the true surface", layout.large,
                           layout.left, layout.right);
  return draw_page(target, [&](vtkContext2D& context) {
    Painter painter(context);
    paint_title(painter, target.width(), target.height(), picture.title, picture.remark, picture.caption);
    views.paint(context);
    paint_curve_plot(context, layout.chart, distance_plot(error));
    paint_surface_error(painter, layout.numbers, picture, error);
  });
}

Image draw_surface_figure(RenderTarget& target, const SurfacePicture& picture) {
  const Surface& surface = surface_of(picture, picture.surface ? picture.surface->uncertainty.size() : 0);
  const std::vector<float> values = in_mm(surface.uncertainty);
  const UncertaintySpread spread = uncertainty_spread(surface);
  const MeshPaint paint{values, surface.seen, ColourMap::contribution(), 0.0, per_mm * spread.end, "uncertainty", "mm"};
  const SurfaceErrorLayout layout(target, picture, 0.4);
  const SurfaceViews views(target, surface.mesh, paint, "How far it may lie off", layout.large, layout.left,
                           layout.right);
  return draw_page(target, [&](vtkContext2D& context) {
    Painter painter(context);
    paint_title(painter, target.width(), target.height(), picture.title, picture.remark, picture.caption);
    views.paint(context);
    paint_curve_plot(context, layout.chart, uncertainty_plot(spread));
    paint_uncertainty(painter, layout.numbers, picture, spread);
  });
}

}  // namespace nextview

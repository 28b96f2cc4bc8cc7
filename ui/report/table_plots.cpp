// Plots whose rows have names: dots with their spread, and matrices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/appearance/colour_map.hpp"
#include "ui/charts/chart.hpp"
#include "ui/report/plot.hpp"

namespace nextview {
namespace {

constexpr double title_height = 44;  // [px]

double widest(const std::vector<std::string>& names) {
  double width = 0.0;
  for (const std::string& name : names) width = std::max(width, text_width(name, theme::small_text));
  return width;
}

/// Without a sign where nothing is left of the number.
std::string cell_text(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  return text.find_first_of("123456789") == std::string::npos ? fmt::format("{:.{}f}", 0.0, digits) : text;
}

/// Dark letters on light cells, light ones on dark cells.
Colour letters_on(const Colour& cell) { return lightness(cell) > 0.66 ? theme::ink : theme::paper; }

/// A mark's name stands over it, or away from one that is too near.
template <class Place>
TextAlign mark_align(const DotPlot& plot, const Place& x, double at, const std::string& name) {
  constexpr double apart = 6;  // [px]
  for (const auto& [other, its_name] : plot.marks) {
    const double room = 0.5 * (text_width(name, theme::small_text) + text_width(its_name, theme::small_text)) + apart;
    if (other != at && std::abs(x(other) - x(at)) < room) return other > at ? TextAlign::right : TextAlign::left;
  }
  return TextAlign::centre;
}

}  // namespace

void draw_dot_plot(VectorDrawing& d, const DrawingArea& area, const DotPlot& plot) {
  const Look& look = d.look();
  const double lower = draw_plot_title(d, area, plot.title);
  const auto label = broken_to(area.width - 32, plot.label, theme::small_text);
  double low = 0.0, high = 0.0;
  std::vector<std::string> names;
  for (const DotPlot::Row& row : plot.rows) {
    low = std::min(low, row.value - row.spread), high = std::max(high, row.value + row.spread);
    names.push_back(row.name);
  }
  for (const auto& [at, name] : plot.marks) low = std::min(low, at), high = std::max(high, at);
  const std::vector<double> ticks = round_ticks(low, std::max(high, low + 1e-9), 6, false);
  const double left = area.left + 28 + widest(names), right = area.right() - 64;
  constexpr double line_height = 17;
  const double more = line_height * double(label.size() > 1 ? label.size() - 1 : 0);
  const double top = area.top + title_height + 20 + lower, bottom = area.bottom() - 48 - more;
  const auto x = [&](double v) { return left + (v - ticks.front()) / (ticks.back() - ticks.front()) * (right - left); };
  for (const double tick : ticks) {
    d.line(x(tick), top, x(tick), bottom, look.hairline);
    d.text(x(tick), bottom + 18, fmt::format("{:g}", tick), theme::small_text, look.soft_ink, TextAlign::centre);
  }
  for (const auto& [at, name] : plot.marks) {
    d.line(x(at), top - 4, x(at), bottom, look.soft_ink, 1.0, true);
    d.text(x(at), top - 9, name, theme::small_text, look.soft_ink, mark_align(plot, x, at, name));
  }
  // What is too wide for its axis stands in the middle of the drawing.
  const double middle = label.size() > 1 ? 0.5 * (area.left + area.right()) : 0.5 * (left + right);
  for (std::size_t i = 0; i < label.size(); ++i)
    d.text(middle, bottom + 38 + line_height * double(i), label[i], theme::small_text, look.soft_ink,
           TextAlign::centre);
  const double step = (bottom - top) / std::max<double>(1.0, double(plot.rows.size()));
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    const DotPlot::Row& row = plot.rows[i];
    const double y = top + (double(i) + 0.5) * step;
    const Colour colour = row.strong ? look.series(0) : look.soft_ink;
    d.text(left - 10, y + 4, row.name, theme::small_text, row.strong ? look.series(0) : look.ink, TextAlign::right,
           row.strong);
    d.line(x(row.value - row.spread), y, x(row.value + row.spread), y, colour, 2.0);
    d.dot(x(row.value), y, 4.5, colour);
    d.text(right + 10, y + 4, fmt::format("{:.3g}", row.value), theme::small_text, look.soft_ink);
  }
}

double least_width(const MatrixPlot& plot) {
  constexpr double apart = 6;
  double cell = 0.5 * (widest(plot.columns) + apart);  // names stand in two heights
  for (const auto& row : plot.values)
    for (const auto& value : row)
      if (value) cell = std::max(cell, text_width(cell_text(*value, plot.digits), theme::small_text) + apart);
  return 44 + widest(plot.rows) + cell * double(plot.columns.size());
}

void draw_matrix(VectorDrawing& d, const DrawingArea& area, const MatrixPlot& plot) {
  const Look& look = d.look();
  const double lower = draw_plot_title(d, area, plot.title);
  d.text(area.left + 16, area.bottom() - 14, plot.note, theme::small_text, look.soft_ink);
  double low = INFINITY, high = -INFINITY;
  for (const auto& row : plot.values)
    for (const auto& value : row)
      if (value) low = std::min(low, *value), high = std::max(high, *value);
  low = plot.low.value_or(low), high = plot.high.value_or(high);
  const double left = area.left + 28 + widest(plot.rows), right = area.right() - 16;
  const double top = area.top + title_height + 26 + lower, bottom = area.bottom() - 36;
  const double width = (right - left) / std::max<double>(1.0, double(plot.columns.size()));
  const double height = (bottom - top) / std::max<double>(1.0, double(plot.rows.size()));
  // Long names of narrow columns stand in two heights.
  const bool staggered = widest(plot.columns) > width - 6;
  for (std::size_t c = 0; c < plot.columns.size(); ++c)
    d.text(left + (double(c) + 0.5) * width, top - 8 - (staggered && c % 2 ? 15 : 0), plot.columns[c],
           theme::small_text, look.ink, TextAlign::centre);
  for (std::size_t r = 0; r < plot.rows.size(); ++r) {
    const double y = top + double(r) * height;
    d.text(left - 10, y + 0.5 * height + 4, plot.rows[r], theme::small_text, look.ink, TextAlign::right);
    for (std::size_t c = 0; c < plot.columns.size(); ++c) {
      const auto& value = plot.values.at(r).at(c);
      if (!value) continue;
      const double share = high > low ? std::clamp((*value - low) / (high - low), 0.0, 1.0) : 0.5;
      const Colour cell =
          (plot.diverging ? ColourMap::deviation() : ColourMap::score()).at(plot.dark_is_high ? share : 1.0 - share);
      d.box(left + double(c) * width + 1, y + 1, width - 2, height - 2, cell);
      d.text(left + (double(c) + 0.5) * width, y + 0.5 * height + 4, cell_text(*value, plot.digits), theme::small_text,
             letters_on(cell), TextAlign::centre);
    }
  }
}

}  // namespace nextview

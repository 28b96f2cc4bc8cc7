// Charts as SVG. The ticks, colours and words are those of the drawn charts (chart.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ui/appearance/markup.hpp"
#include "ui/charts/axis_scale.hpp"
#include "ui/charts/chart_page.hpp"

namespace nextview {
namespace {

constexpr double margin = 16, left_margin = 62, right_margin = 16, top_margin = 62, bottom_margin = 48;  // [px]

/// Where values lie on the page.
class Axes {
 public:
  Axes(const ChartContent& content, double left, double top, double width, double height)
      : left_(left + left_margin),
        right_(left + width - right_margin),
        top_(top + top_margin),
        bottom_(top + height - bottom_margin) {
    constexpr double none = std::numeric_limits<double>::infinity();
    double x_low = none, x_high = -none, y_low = 0.0, y_high = content.y_high.value_or(-none);
    for (const ChartSeries& series : content.series)
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
        x_low = std::min(x_low, series.x[i]), x_high = std::max(x_high, series.x[i]);
        y_low = std::min(y_low, series.y[i]);
        if (!content.y_high) y_high = std::max(y_high, series.y[i]);
      }
    if (x_low > x_high) x_low = 0, x_high = 1;
    if (y_high < y_low) y_high = y_low + 1;
    scale = AxisScale::of(std::max(std::abs(y_low), std::abs(y_high)));
    x_ticks = round_ticks(x_low, x_high, 8, content.whole_x);
    y_ticks = round_ticks(y_low / scale.factor, y_high / scale.factor, 5, false);
  }

  double x(double value) const { return left_ + share(value, x_ticks) * (right_ - left_); }
  double y(double value) const { return y_of_tick(value / scale.factor); }
  double y_of_tick(double tick) const { return bottom_ - share(tick, y_ticks) * (bottom_ - top_); }
  double left() const { return left_; }
  double right() const { return right_; }
  double top() const { return top_; }
  double bottom() const { return bottom_; }

  AxisScale scale;  ///< of y
  std::vector<double> x_ticks, y_ticks;

 private:
  static double share(double value, const std::vector<double>& ticks) {
    return (value - ticks.front()) / (ticks.back() - ticks.front());
  }
  double left_, right_, top_, bottom_;  ///< [px]
};

std::string svg_line(double x1, double y1, double x2, double y2, const Colour& colour) {
  return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2,
                     markup_colour(colour));
}

std::string text(double x, double y, const std::string& words, int size, const Colour& colour, const char* anchor,
                 const std::string& more = "") {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x,
                     y, size, markup_colour(colour), anchor, more, markup_text(words));
}

std::string tick_text(double tick) { return fmt::format("{:g}", std::abs(tick) < 1e-12 ? 0.0 : tick); }

std::string grid(const ChartContent& content, const Axes& axes) {
  std::string svg;
  for (const double tick : axes.y_ticks) {
    const double y = axes.y_of_tick(tick);
    svg += svg_line(axes.left(), y, axes.right(), y, theme::hairline);
    svg += text(axes.left() - 8, y + 4, tick_text(tick), theme::small_text, theme::soft_ink, "end");
  }
  for (const double tick : axes.x_ticks) {
    svg += svg_line(axes.x(tick), axes.top(), axes.x(tick), axes.bottom(), theme::hairline);
    svg += text(axes.x(tick), axes.bottom() + 18, tick_text(tick), theme::small_text, theme::soft_ink, "middle");
  }
  svg += svg_line(axes.left(), axes.bottom(), axes.right(), axes.bottom(), theme::soft_ink);
  svg += svg_line(axes.left(), axes.bottom(), axes.left(), axes.top(), theme::soft_ink);
  svg += text(0.5 * (axes.left() + axes.right()), axes.bottom() + 38,
              AxisScale().title(content.x_label, content.x_unit), theme::small_text, theme::soft_ink, "middle");
  const double x = axes.left() - left_margin + 14, y = 0.5 * (axes.top() + axes.bottom());
  svg += text(x, y, axes.scale.title(content.y_label, content.y_unit), theme::small_text, theme::soft_ink, "middle",
              fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", x, y));
  return svg;
}

/// A value that is not finite ends a line, and the next one begins another.
std::string curve(const ChartContent& content, const ChartSeries& series, const Axes& axes, const std::string& colour) {
  std::string svg, dots, points;
  const auto end_line = [&] {
    if (!points.empty())
      svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2\" points=\"{}\"/>\n", colour, points);
    points.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) {
      end_line();
      continue;
    }
    const double x = axes.x(series.x[i]), y = axes.y(series.y[i]);
    points += fmt::format("{}{:.2f},{:.2f}", points.empty() ? "" : " ", x, y);
    dots += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3\" fill=\"{}\"><title>{}</title></circle>\n", x, y,
                        colour,
                        markup_text(fmt::format("{} {:g}, {}: {:g} {}", content.x_label, series.x[i], series.name,
                                                series.y[i], content.y_unit)));
  }
  end_line();
  return svg + dots;
}

/// The curves' names beneath the title, in as many rows as they need. An estimate of their width will do: the fonts are
/// the reader's.
class Names {
 public:
  Names(const ChartContent& content, double left, double top, double right) {
    if (content.series.size() < 2) return;
    double x = left, y = top;
    for (std::size_t i = 0; i < content.series.size(); ++i) {
      const std::string& name = content.series[i].name;
      const auto letters = std::ranges::count_if(name, [](char c) { return (c & 0xC0) != 0x80; });  // of UTF-8
      const double width = 22 + 7.2 * double(letters);
      if (x > left && x + width > right) x = left, y += row;
      svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"16\" height=\"3\" fill=\"{}\"/>\n", x, y - 6,
                         markup_colour(theme::series[i % theme::series.size()]));
      svg += text(x + 22, y, name, theme::small_text, theme::ink, "start");
      x += width + 18;
    }
    more_height = y - top;
  }

  std::string svg;
  double more_height = 0;  ///< than one row has [px]

 private:
  static constexpr double row = 18;  // [px]
};

std::string chart(const ChartContent& content, double left, double top, double width, double height) {
  for (const ChartSeries& series : content.series)
    if (series.x.size() != series.y.size())
      throw std::invalid_argument(
          fmt::format("series '{}': {} x for {} y", series.name, series.x.size(), series.y.size()));
  const Names names(content, left + margin, top + 48, left + width - right_margin);
  const Axes axes(content, left, top + names.more_height, width, height - names.more_height);
  std::string svg = "<g>\n" + text(left + margin, top + 26, content.title, theme::caption, theme::ink, "start",
                                   " font-weight=\"600\"");
  svg += names.svg;
  svg += grid(content, axes);
  for (std::size_t i = 0; i < content.series.size(); ++i)
    svg += curve(content, content.series[i], axes, markup_colour(theme::series[i % theme::series.size()]));
  return svg + "</g>\n";
}

}  // namespace

std::string charts_svg(std::span<const ChartContent> charts, const PictureSize& size, bool transparent) {
  const PictureSize page = page_size(charts.size());
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" "
      "height=\"{}\" "
      "viewBox=\"0 0 {} {}\" font-family=\"Inter, Helvetica, Arial, sans-serif\">\n",
      size.width, size.height, page.width, page.height);
  if (!transparent)
    svg += fmt::format("<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n", markup_colour(theme::paper));
  const std::size_t columns = charts.size() > 1 ? 2 : 1, rows = (charts.size() + columns - 1) / columns;
  const double width = double(page.width) / double(columns), height = double(page.height) / double(rows);
  for (std::size_t i = 0; i < charts.size(); ++i)
    svg += chart(charts[i], width * double(i % columns), height * double(i / columns), width, height);
  return svg + "</svg>\n";
}

}  // namespace nextview

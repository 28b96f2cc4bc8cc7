#include "ui/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/appearance/colour_map.hpp"
#include "ui/charts/chart.hpp"

namespace nextview {
namespace {

constexpr double left_room = 58, top_room = 62, bottom_room = 50;  // [px]
constexpr double name_distance = 17;                               // of lines [px]
constexpr double leaders_room = 40;                                // between curves and their names [px]

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
};

double spread_of(const PlotSeries& s, std::size_t i) { return i < s.spread.size() ? s.spread[i] : 0.0; }

/// Where values lie.
class Axes {
 public:
  Axes(const Plot& plot, const DrawingArea& area) : logarithmic_(plot.logarithmic_y), area_(area) {
    Range x, y;
    for (const PlotSeries& s : plot.series)
      for (std::size_t i = 0; i < s.x.size(); ++i) {
        if (logarithmic_ && s.y[i] <= 0.0) continue;
        x.add(s.x[i]);
        y.add(logarithmic_ ? s.y[i] : s.y[i] - spread_of(s, i)), y.add(s.y[i] + spread_of(s, i));
      }
    if (x.low > x.high) x = {0, 1}, y = {0, 1};
    constexpr double tick_room = 45;  // [px]
    const int most_ticks = std::clamp(int(area.width / tick_room), 2, 8);
    x_ticks = round_ticks(plot.x_low.value_or(x.low), plot.x_high.value_or(x.high), most_ticks, plot.whole_x);
    const double low = plot.y_low.value_or(logarithmic_ ? y.low : std::min(0.0, y.low)),
                 high = plot.y_high.value_or(y.high);
    if (logarithmic_)
      for (double tick = std::pow(10.0, std::floor(std::log10(low))); tick < 10.0 * high; tick *= 10.0)
        y_ticks.push_back(tick);
    else
      y_ticks = round_ticks(low, std::max(high, low + 1e-9), 6, false);
  }

  double x(double value) const {
    return area_.left + (value - x_ticks.front()) / (x_ticks.back() - x_ticks.front()) * area_.width;
  }
  double y(double value) const {
    const auto at = [&](double v) { return logarithmic_ ? std::log10(v) : v; };
    const double share = (at(value) - at(y_ticks.front())) / (at(y_ticks.back()) - at(y_ticks.front()));
    return area_.bottom() - std::clamp(share, 0.0, 1.0) * area_.height;
  }
  std::vector<double> x_ticks, y_ticks;

 private:
  bool logarithmic_;
  DrawingArea area_;
};

std::string tick_text(double tick) { return fmt::format("{:g}", std::abs(tick) < 1e-12 ? 0.0 : tick); }

void draw_axes(VectorDrawing& d, const DrawingArea& inner, const Plot& plot, const Axes& axes) {
  const Look& look = d.look();
  for (const double tick : axes.y_ticks) {
    d.line(inner.left, axes.y(tick), inner.right(), axes.y(tick), look.hairline);
    d.text(inner.left - 8, axes.y(tick) + 4, tick_text(tick), theme::small_text, look.soft_ink, TextAlign::right);
  }
  for (const double tick : axes.x_ticks)
    d.text(axes.x(tick), inner.bottom() + 18, tick_text(tick), theme::small_text, look.soft_ink, TextAlign::centre);
  d.line(inner.left, inner.bottom(), inner.right(), inner.bottom(), look.soft_ink);
  d.text(0.5 * (inner.left + inner.right()), inner.bottom() + 38, plot.x_label, theme::small_text, look.soft_ink,
         TextAlign::centre);
  d.text(inner.left - left_room + 16, inner.top - 14, plot.y_label, theme::small_text, look.soft_ink);
}

void draw_series(VectorDrawing& d, const PlotSeries& s, const Axes& axes) {
  const Colour colour = d.look().on_paper(s.colour);
  const auto place = [&](std::size_t i, double up) { return Eigen::Vector2d(axes.x(s.x[i]), axes.y(s.y[i] + up)); };
  for (std::size_t i = 1; i < s.x.size() && !s.spread.empty(); ++i)
    d.area({place(i - 1, spread_of(s, i - 1)), place(i, spread_of(s, i)), place(i, -spread_of(s, i)),
            place(i - 1, -spread_of(s, i - 1))},
           colour, 0.14);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < s.x.size(); ++i) points.push_back(place(i, 0.0));
  if (!s.joined || points.size() == 1)
    for (const Eigen::Vector2d& p : points) d.dot(p.x(), p.y(), 3.0, colour);
  else
    d.line(std::move(points), colour, s.thickness, s.dashed);
}

/// At the right end of each curve, moved apart where they are near each other; of dots at the top, with one beside it.
void draw_names(VectorDrawing& d, const DrawingArea& inner, const Plot& plot, const Axes& axes) {
  struct Name {
    const PlotSeries* series;
    double wanted, y;
  };
  std::vector<Name> names;
  for (const PlotSeries& s : plot.series)
    if (!s.x.empty() && !s.name.empty()) {
      const double end = s.joined ? axes.y(s.y.back()) : inner.top + 4;
      names.push_back({&s, end, end});
    }
  std::ranges::stable_sort(names, {}, &Name::wanted);
  for (std::size_t i = 1; i < names.size(); ++i) names[i].y = std::max(names[i].y, names[i - 1].y + name_distance);
  double lowest = inner.bottom() + 4;
  for (std::size_t i = names.size(); i-- > 0; lowest = names[i].y - name_distance)
    names[i].y = std::min(names[i].y, lowest);
  for (const Name& name : names) {
    const Colour colour = d.look().on_paper(name.series->colour);
    if (name.series->joined) {
      d.line({{axes.x(name.series->x.back()) + 3, name.wanted},
              {inner.right() + leaders_room - 6, name.y},
              {inner.right() + leaders_room, name.y}},
             mix(d.look().paper, colour, 0.4), 1.0, name.series->dashed);
      d.dot(axes.x(name.series->x.back()), name.wanted, 2.5, colour);
    } else {
      d.dot(inner.right() + leaders_room - 5, name.y, 3.0, colour);
    }
    const bool is_background = name.series->colour == theme::muted;  // its line may be faint, its name may not
    d.text(inner.right() + leaders_room + 5, name.y + 4, name.series->name, theme::small_text,
           is_background ? d.look().soft_ink : colour, TextAlign::left, name.series->thickness > 2.0);
  }
}

}  // namespace

double draw_plot_title(VectorDrawing& d, const DrawingArea& area, const std::string& title) {
  constexpr double line_height = 20;
  const auto lines = broken_to(area.width - 24, title, theme::caption);
  for (std::size_t i = 0; i < lines.size(); ++i)
    d.text(area.left + 16, area.top + 26 + line_height * double(i), lines[i], theme::caption, d.look().ink,
           TextAlign::left, true);
  return line_height * (std::max<double>(1.0, double(lines.size())) - 1.0);
}

void draw_plot(VectorDrawing& d, const DrawingArea& area, const Plot& plot) {
  double names = 28;  // of the last tick's half
  for (const PlotSeries& s : plot.series)
    if (!s.name.empty()) names = std::max(names, leaders_room + 18 + text_width(s.name, theme::small_text));
  const double top = top_room + draw_plot_title(d, area, plot.title);
  const DrawingArea inner{area.left + left_room, area.top + top, area.width - left_room - names,
                          area.height - top - bottom_room};
  const Axes axes(plot, inner);
  draw_axes(d, inner, plot, axes);
  if (plot.diagonal) {
    const double low = std::max(axes.x_ticks.front(), axes.y_ticks.front()),
                 high = std::min(axes.x_ticks.back(), axes.y_ticks.back());
    d.line(axes.x(low), axes.y(low), axes.x(high), axes.y(high), d.look().soft_ink, 1.0, true);
  }
  for (const PlotSeries& s : plot.series) draw_series(d, s, axes);
  draw_names(d, inner, plot, axes);
}

}  // namespace nextview

#include "ui/charts/curve_plot.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ui/charts/chart.hpp"
#include "ui/charts/curve_names.hpp"

namespace nextview {
namespace {

constexpr double left_room = 62, right_room = 8, bottom_room = 44;  // [px]
constexpr double between_x_ticks = 44, between_y_ticks = 56;        // [px], at least about

/// Where values lie in the plot's area.
class Frame {
 public:
  Frame(const CurvePlot& plot, const PageArea& area) : plot_(plot), area_(area) {}

  double x(double value) const {
    return area_.left + (value - plot_.x_low) / (plot_.x_high - plot_.x_low) * area_.width;
  }
  double y(double value) const {
    const double low = scaled(plot_.y_low), high = scaled(plot_.y_high);
    return area_.bottom + (scaled(value) - low) / (high - low) * area_.height;
  }
  const PageArea& area() const { return area_; }
  const CurvePlot& plot() const { return plot_; }

 private:
  /// A logarithm far below the axis for 0, so that curves go down there.
  double scaled(double value) const {
    return !plot_.logarithmic_y ? value : value > 0 ? std::log10(value) : std::log10(plot_.y_low) - 1e3;
  }

  const CurvePlot& plot_;
  PageArea area_;
};

std::vector<double> within(std::vector<double> ticks, double low, double high) {
  const double slack = 1e-9 * (high - low);
  std::erase_if(ticks, [&](double tick) { return tick < low - slack || tick > high + slack; });
  return ticks;
}

std::vector<double> y_ticks(const CurvePlot& plot, double height) {
  if (!plot.logarithmic_y)
    return within(round_ticks(plot.y_low, plot.y_high, int(height / between_y_ticks), false), plot.y_low, plot.y_high);
  std::vector<double> powers;
  for (double tick = plot.y_low; tick <= plot.y_high * 1.001; tick *= 10) powers.push_back(tick);
  return powers;
}

/// With as many decimals as the ticks' distance needs, the same at all of them.
std::string number(double tick, const std::vector<double>& ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", std::abs(tick) < 1e-9 * step ? 0.0 : tick, decimals);
}

void paint_axes(vtkContext2D& context, const Frame& frame) {
  Painter painter(context);
  const CurvePlot& plot = frame.plot();
  const PageArea& area = frame.area();
  const auto x_ticks = within(round_ticks(plot.x_low, plot.x_high, int(area.width / between_x_ticks), plot.whole_x),
                              plot.x_low, plot.x_high);
  for (const double tick : x_ticks) {
    painter.line(frame.x(tick), area.bottom, frame.x(tick), area.top(), 1, theme::hairline);
    painter.text(frame.x(tick), area.bottom - 20, number(tick, x_ticks), theme::small_text, theme::soft_ink,
                 TextWeight::regular, TextAlign::centre);
  }
  const auto ticks = y_ticks(plot, area.height);
  for (const double tick : ticks) {
    painter.line(area.left, frame.y(tick), area.right(), frame.y(tick), 1, theme::hairline);
    painter.text(area.left - 6, frame.y(tick) - 7, plot.logarithmic_y ? fmt::format("{:g}", tick) : number(tick, ticks),
                 theme::small_text, theme::soft_ink, TextWeight::regular, TextAlign::right);
  }
  painter.line(area.left, area.bottom, area.right(), area.bottom, 1, theme::soft_ink);
  painter.line(area.left, area.bottom, area.left, area.top(), 1, theme::soft_ink);
  painter.text(area.left + 0.5 * area.width, area.bottom - 40, plot.x_label, theme::small_text, theme::soft_ink,
               TextWeight::regular, TextAlign::centre);

  vtkTextProperty& upright = *context.GetTextProp();
  set_text(upright, theme::small_text, theme::soft_ink);
  upright.SetJustificationToCentered();
  upright.SetOrientation(90);
  keep_text(upright);
  context.DrawString(float(area.left - left_room + 16), float(std::round(area.bottom + 0.5 * area.height)),
                     plot.y_label.c_str());
  upright.SetOrientation(0);
}

void paint_part(Painter& painter, const Frame& frame, const CurvePlot::Part& part) {
  const double from = frame.x(std::max(part.from, frame.plot().x_low));
  const double to = frame.x(std::min(part.to, frame.plot().x_high));
  if (to <= from) return;
  painter.box(from, frame.area().bottom, to - from, frame.area().height, theme::sky);
  const double base = part.is_named_below ? frame.area().bottom + 6 : frame.area().top() - 20;
  painter.text(from + 6, base, part.name, theme::small_text, theme::soft_ink);
}

void paint_bar(Painter& painter, const Frame& frame, const CurvePlot::Bar& bar) {
  const PageArea& area = frame.area();
  const double left = std::max(frame.x(bar.from), area.left), right = std::min(frame.x(bar.to), area.right());
  const double top = std::min(frame.y(bar.y), area.top());
  if (right <= left || !(top > area.bottom)) return;
  const Colour edge = mix(bar.colour, theme::ink, 0.35);  // pale bars would be lost on the paper
  painter.box(left, area.bottom, right - left, top - area.bottom, edge);
  if (right - left > 3 && top - area.bottom > 1)
    painter.box(left + 1, area.bottom, right - left - 2, top - area.bottom - 1, bar.colour);
}

/// What is seen of it, in unbroken runs: x and y in turn.
std::vector<std::vector<float>> visible_runs(const Frame& frame, const Curve& curve) {
  std::vector<std::vector<float>> runs(1);
  for (std::size_t i = 1; i < curve.x.size(); ++i) {
    const Eigen::Vector2d from(frame.x(curve.x[i - 1]), frame.y(curve.y[i - 1]));
    const Eigen::Vector2d to(frame.x(curve.x[i]), frame.y(curve.y[i]));
    LinePiece piece{from, to};
    if (!from.allFinite() || !to.allFinite() || !clip(piece, frame.area().box())) continue;
    if (!runs.back().empty() && piece[0] != from) runs.emplace_back();
    std::vector<float>& run = runs.back();
    if (run.empty()) run = {float(piece[0].x()), float(piece[0].y())};
    run.push_back(float(piece[1].x()));
    run.push_back(float(piece[1].y()));
    if (piece[1] != to) runs.emplace_back();
  }
  return runs;
}

void paint_curve(vtkContext2D& context, const Frame& frame, const Curve& curve) {
  for (std::vector<float>& run : visible_runs(frame, curve)) {
    if (run.empty()) continue;
    vtkPen& pen = *context.GetPen();
    pen.SetLineType(vtkPen::SOLID_LINE);
    pen.SetColorF(curve.colour[0], curve.colour[1], curve.colour[2]);
    pen.SetOpacityF(1.0);
    pen.SetWidth(2);
    context.DrawPoly(run.data(), static_cast<int>(run.size() / 2));
  }
}

double paint_names_above(Painter& painter, double left, double top, double width, const std::vector<Curve>& curves) {
  std::vector<CurveName> names;
  for (const Curve& curve : curves) names.push_back({curve.name, curve.colour});
  return paint_curve_names(painter, left, top, width, names) + 10;
}

void paint_names_beside(Painter& painter, double left, double top, const std::vector<Curve>& curves) {
  double y = top;
  for (const Curve& curve : curves) {
    y -= 20;
    painter.line(left, y + 7, left + curve_sample, y + 7, 2, curve.colour);
    painter.text(left + curve_sample + curve_sample_gap, y, curve.name, theme::small_text, theme::ink,
                 TextWeight::semi_bold);
    for (const std::string& detail : curve.details) {
      y -= 18;
      painter.text(left + curve_sample + curve_sample_gap, y, detail, theme::small_text, theme::soft_ink);
    }
    y -= 8;
  }
}

}  // namespace

void paint_curve_plot(vtkContext2D& context, const PageArea& panel, const CurvePlot& plot) {
  for (const Curve& curve : plot.curves)
    if (curve.x.size() != curve.y.size())
      throw std::invalid_argument(fmt::format("curve '{}': {} x for {} y", curve.name, curve.x.size(), curve.y.size()));
  Painter painter(context);
  paint_panel(painter, panel, plot.title, plot.remark);
  const double left = panel.left + page_margin, width = panel.width - 2 * page_margin;
  const double top = panel.top() - heading_height, bottom = panel.bottom + bottom_room + 8;
  double above = 8.0;
  if (plot.names_width > 0.0)
    paint_names_beside(painter, left + width - plot.names_width, top, plot.curves);
  else
    above = paint_names_above(painter, left, top, width, plot.curves);
  const double beside = plot.names_width > 0.0 ? plot.names_width + 12 : 0.0;
  const PageArea area{left + left_room, bottom, width - left_room - right_room - beside, top - above - bottom};
  const Frame frame(plot, area);
  for (const CurvePlot::Part& part : plot.parts) paint_part(painter, frame, part);
  paint_axes(context, frame);
  for (const CurvePlot::Bar& bar : plot.bars) paint_bar(painter, frame, bar);
  for (const Curve& curve : plot.curves) paint_curve(context, frame, curve);
}

}  // namespace nextview

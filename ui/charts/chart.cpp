#include "ui/charts/chart.hpp"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "ui/charts/axis_scale.hpp"
#include "ui/charts/curve_names.hpp"
#include "ui/drawing/painter.hpp"
#include "ui/render_target/render_target.hpp"

namespace nextview {
namespace {

unsigned char channel(double value) { return static_cast<unsigned char>(std::lround(value * 255)); }

void set_pen(vtkPen& pen, const Colour& colour, double width) {
  pen.SetColor(channel(colour[0]), channel(colour[1]), channel(colour[2]), 255);
  pen.SetWidth(float(width));
}

/// The margins are shares of the range that stay free at its ends, so that no marker is cut.
void set_ticks(vtkAxis& axis, const std::vector<double>& ticks, double low_margin, double high_margin) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const double tick : ticks) {
    positions->InsertNextValue(tick);
    labels->InsertNextValue(fmt::format("{:g}", std::abs(tick) < 1e-12 ? 0.0 : tick));
  }
  axis.SetCustomTickPositions(positions, labels);
  axis.SetBehavior(vtkAxis::FIXED);
  const double range = ticks.back() - ticks.front();
  axis.SetRange(ticks.front() - low_margin * range, ticks.back() + high_margin * range);
}

void style_axis(vtkAxis& axis, const std::string& title, double scale) {
  const int size = int(std::lround(theme::small_text * scale));
  axis.SetTitle(title);
  set_text(*axis.GetTitleProperties(), size, theme::soft_ink);
  set_text(*axis.GetLabelProperties(), size, theme::soft_ink);
  set_pen(*axis.GetPen(), theme::soft_ink, scale);
  set_pen(*axis.GetGridPen(), theme::hairline, scale);
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
};

/// `hidden`: beneath another, beside which it is seen if it is wide.
void add_series(vtkChartXY& chart, const ChartSeries& series, const Colour& colour, double y_factor, bool hidden,
                double scale) {
  vtkNew<vtkDoubleArray> x, y;
  x->SetName("x");
  y->SetName(series.name.c_str());
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    x->InsertNextValue(series.x[i]);
    y->InsertNextValue(series.y[i] / y_factor);
  }
  vtkNew<vtkTable> table;
  table->AddColumn(x);
  table->AddColumn(y);
  // VTK takes a line through a single point for an error.
  auto* plot = vtkPlotPoints::SafeDownCast(chart.AddPlot(series.x.size() > 1 ? vtkChart::LINE : vtkChart::POINTS));
  plot->SetInputData(table, 0, 1);
  set_pen(*plot->GetPen(), colour, scale * (hidden ? 6 : 2));
  plot->SetMarkerStyle(vtkPlotPoints::CIRCLE);
  plot->SetMarkerSize(float(scale * (hidden ? 12 : 6)));
}

/// Whether a curve would be hidden beneath another.
bool lies_on(const ChartSeries& a, const ChartSeries& b, double y_range) {
  constexpr double unseen = 0.01;
  return a.x == b.x && std::ranges::equal(a.y, b.y, [&](double y, double other) {
           return std::abs(y - other) <= unseen * y_range || (std::isnan(y) && std::isnan(other));
         });
}

/// A chart with its title at the left, as all panels have it, its curves' names beneath, where no curve runs, and a
/// margin all around.
class TitledChart : public vtkChartXY {
 public:
  static TitledChart* New();
  vtkTypeMacro(TitledChart, vtkChartXY)

      bool Paint(vtkContext2D* context) override {
    constexpr double margin = 16, title = 36;  // [px] of the design, as all here
    const double width = GetScene()->GetSceneWidth() / scale, height = GetScene()->GetSceneHeight() / scale;
    Painter painter(*context, scale);
    painter.text(margin, height - 30, heading, theme::caption, theme::ink, TextWeight::semi_bold);
    double rows = 0;
    if (names.size() > 1) rows = paint_curve_names(painter, margin, height - title, width - 2 * margin, names);
    const auto px = [&](double length) { return float(length * scale); };
    SetSize(vtkRectf(px(margin), px(4), px(width - 2 * margin), px(height - title - rows - 8)));
    return vtkChartXY::Paint(context);
  }

  double scale = 1.0;  ///< pixels of the display a pixel of the design
  std::string heading;
  std::vector<CurveName> names;
};

vtkStandardNewMacro(TitledChart);

}  // namespace

struct Chart::Parts {
  vtkNew<vtkContextActor> actor;
  vtkNew<TitledChart> chart;
};

Chart::Chart() : renderer_(vtkSmartPointer<vtkRenderer>::New()), parts_(std::make_unique<Parts>()) {
  renderer_->SetBackground(theme::paper.data());
  vtkChartXY& chart = *parts_->chart;
  chart.SetAutoSize(false);
  chart.SetInteractive(false);
  parts_->actor->GetScene()->AddItem(&chart);
  parts_->actor->GetScene()->SetRenderer(renderer_);
  renderer_->AddActor(parts_->actor);
}

Chart::~Chart() {
  parts_->actor->GetScene()->SetRenderer(nullptr);
  if (vtkRenderWindow* window = renderer_->GetRenderWindow()) window->RemoveRenderer(renderer_);
}

void Chart::attach(RenderTarget& target, const Viewport& viewport) {
  renderer_->SetViewport(viewport.left, viewport.bottom, viewport.right, viewport.top);
  target.window().AddRenderer(renderer_);
}

/// How far labels are from their axis stays: VTK has a fixed distance for the title behind them.
void Chart::set_scale(double scale) { parts_->chart->scale = scale; }

void Chart::show(const ChartContent& content) {
  Extent x, y;
  for (const ChartSeries& series : content.series) {
    if (series.x.size() != series.y.size()) {
      throw std::invalid_argument(
          fmt::format("series '{}': {} x for {} y", series.name, series.x.size(), series.y.size()));
    }
    std::for_each(series.x.begin(), series.x.end(), [&](double value) { x.add(value); });
    std::for_each(series.y.begin(), series.y.end(), [&](double value) { y.add(value); });
  }
  if (x.empty() || y.empty()) x.low = 0, x.high = 1, y.low = 0, y.high = 1;
  const double top = content.y_high.value_or(y.high);
  const AxisScale scale = AxisScale::of(std::max(std::abs(y.low), std::abs(top)));
  TitledChart& chart = *parts_->chart;
  chart.ClearPlots();
  chart.heading = content.title;
  chart.names.clear();
  for (std::size_t i = 0; i < content.series.size(); ++i) {
    const auto later = std::span(content.series).subspan(i + 1);
    const bool hidden = std::ranges::any_of(
        later, [&](const ChartSeries& other) { return lies_on(content.series[i], other, top - std::min(0.0, y.low)); });
    const Colour& colour = theme::series[i % theme::series.size()];
    add_series(chart, content.series[i], colour, scale.factor, hidden, chart.scale);
    chart.names.push_back({content.series[i].name, colour});
  }
  style_axis(*chart.GetAxis(vtkAxis::BOTTOM), AxisScale().title(content.x_label, content.x_unit), chart.scale);
  style_axis(*chart.GetAxis(vtkAxis::LEFT), scale.title(content.y_label, content.y_unit), chart.scale);
  set_ticks(*chart.GetAxis(vtkAxis::BOTTOM), round_ticks(x.low, x.high, 8, content.whole_x), 0.02, 0.02);
  set_ticks(*chart.GetAxis(vtkAxis::LEFT),
            round_ticks(std::min(0.0, y.low) / scale.factor, top / scale.factor, 5, false), 0.0, 0.03);
}

}  // namespace nextview

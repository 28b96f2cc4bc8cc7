#include "ui/panels/curves_panel.hpp"

#include <fmt/format.h>

#include "ui/panels/plot.hpp"

namespace nextview {
namespace {

ChartContent entropy_content(const SessionSnapshot& s) {
  ChartContent content{"Entropy of the map [Mbit]", "view", "", "entropy", "Mbit", {}, {}, true};
  const double nothing_known = double(s.grid.voxel_count()) / 1e6;
  ChartSeries unmeasured{"unmeasured (Eq. 18)", {0}, {nothing_known}};
  ChartSeries total{"total, ΣH(p)", {0}, {nothing_known}};
  for (const StepRecord& r : s.records) {
    for (ChartSeries* series : {&unmeasured, &total}) series->x.push_back(r.step);
    unmeasured.y.push_back(r.entropy / 1e6);
    total.y.push_back(r.total_entropy / 1e6);
  }
  content.series = {unmeasured, total};
  return content;
}

ChartContent coverage_content(const SessionSnapshot& s) {
  ChartContent content{"", "view", "", "coverage", "%", {}, 100.0, true};
  const EvaluationConfig& evaluation = s.configuration.evaluation;
  if (!evaluation.enabled) {
    content.title = "Surface coverage: evaluation is off";
    return content;
  }
  content.title = fmt::format("Surface within {:g} mm of a point [%]", 1e3 * evaluation.d_reg);
  ChartSeries visible{"of visible surface", {0}, {0}}, all{"of all surface", {0}, {0}};
  for (const StepRecord& r : s.records) {
    for (ChartSeries* series : {&visible, &all}) series->x.push_back(r.step);
    visible.y.push_back(100 * r.coverage_visible);
    all.y.push_back(100 * r.coverage);
  }
  content.series = {visible, all};
  return content;
}

}  // namespace

void draw_curves_panel(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Curves", rectangle, ImGuiWindowFlags_NoScrollbar);
  if (!context.snapshot.loaded()) return;
  const double margin = context.style.px(14), top = context.style.px(10), half = rectangle.width / 2;
  const auto part = [&](int index) {
    return Rectangle{rectangle.x + index * half + margin, rectangle.y + top, half - margin,
                     rectangle.height - top - context.style.px(8)};
  };
  draw_plot(context.style, entropy_content(context.snapshot), part(0));
  draw_plot(context.style, coverage_content(context.snapshot), part(1));
}

}  // namespace nextview

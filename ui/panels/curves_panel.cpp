#include "ui/panels/curves_panel.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

#include "ui/charts/scan_curves.hpp"
#include "ui/commands/window_commands.hpp"
#include "ui/panels/plot.hpp"

namespace nextview {
namespace {

constexpr std::array kind_names = {"entropy", "coverage", "divergence", "gain", "time"};

ScanCourse course_of(const SessionSnapshot& s, std::span<const StepRecord> records) {
  return {records, s.setup->start_entropy, s.setup->d_reg(), s.gain_unit, s.is_evaluated(), s.orders.get()};
}

/// The branches that the scan is not on, as far as it is known what came of their views.
std::vector<std::pair<std::string, std::vector<StepRecord>>> other_branches(const SessionSnapshot& s,
                                                                            const std::string& compared) {
  std::vector<std::pair<std::string, std::vector<StepRecord>>> result;
  if (!s.timeline) return result;
  for (const Branch& branch : s.timeline->branches.all) {
    if (branch == s.timeline->branches.current() || branch.name == compared) continue;
    std::vector<StepRecord> records;
    for (const TimelineStep* step : s.timeline->line(branch)) {
      if (!step->record) break;
      records.push_back(*step->record);
    }
    if (!records.empty()) result.emplace_back("'" + branch.name + "'", std::move(records));
  }
  return result;
}

ChartContent chart_of(const ScanCourse& course, CurveKind kind) {
  switch (kind) {
    case CurveKind::coverage:
      return coverage_chart(course);
    case CurveKind::divergence:
      return divergence_chart(course);
    case CurveKind::gain:
      return gain_chart(course);
    case CurveKind::time:
      return time_chart(course);
    case CurveKind::entropy:
      break;
  }
  return entropy_chart(course);
}

/// Of other runs with the same object the first curve, from its first view: all of them would be a tangle. Those that
/// are not compared are pale.
void add_other_runs(ChartContent& content, const SessionSnapshot& s, CurveKind kind) {
  const auto add = [&](const std::string& name, std::span<const StepRecord> records, bool pale) {
    ChartSeries series = chart_of(course_of(s, records), kind).series.front();
    if (series.x.size() < records.size()) return;  // of a recording's own curves
    const auto before = std::ptrdiff_t(series.x.size() - records.size());
    series.x.erase(series.x.begin(), series.x.begin() + before);
    series.y.erase(series.y.begin(), series.y.begin() + before);
    series.name = pale ? name : fmt::format("{}, {}", name, series.name);
    series.earlier = pale;
    content.series.push_back(std::move(series));
  };
  const std::string compared = s.compared ? s.compared->branch : "";
  if (s.compared && !s.compared->snapshot->records.empty())
    add("'" + compared + "'", s.compared->snapshot->records, false);
  for (const auto& [name, records] : other_branches(s, compared)) add(name, records, true);
  if (!s.earlier_runs) return;
  for (const Run& run : *s.earlier_runs)
    if (run.object == s.object_name) add(run.name, run.records, true);
}

/// Which curves a plot shows; at the right of its title.
void draw_choice(const PanelContext& context, std::size_t plot, const Rectangle& r) {
  const Style& style = context.style;
  ImGui::SetCursorScreenPos({float(r.x + r.width) - style.px(34), float(r.y) - style.px(2)});
  ImGui::PushFont(style.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(style.px(6), style.px(2)));
  const auto now = static_cast<std::size_t>(context.window.curves[plot]);
  if (ImGui::BeginCombo(fmt::format("##curves {}", plot).c_str(), kind_names[now],
                        ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) {
    for (std::size_t i = 0; i < kind_names.size(); ++i) {
      if (!ImGui::Selectable(kind_names[i], i == now)) continue;
      auto chosen = context.window.curves;
      chosen[plot] = static_cast<CurveKind>(i);
      context.post(command::curves(chosen[0], chosen[1]));
    }
    ImGui::EndCombo();
  }
  tooltip("Choose what this plot shows.");
  ImGui::PopStyleVar();
  ImGui::PopFont();
}

}  // namespace

ScanCourse scan_course(const SessionSnapshot& s) { return course_of(s, s.records); }

ChartContent curve_content(const SessionSnapshot& s, CurveKind kind) {
  const ScanCourse course = scan_course(s);
  if (kind == CurveKind::coverage && s.is_recording()) return recorded_coverage_chart(course);
  const bool needs_truth = kind == CurveKind::coverage || kind == CurveKind::divergence;
  if (needs_truth && !course.is_evaluated)
    return {s.configuration.evaluation.enabled ? "The true surface is not known"
                                               : "The true surface is not looked at: evaluation is off",
            "view",
            "",
            "",
            "",
            {},
            {},
            true};
  ChartContent content = chart_of(course, kind);
  add_other_runs(content, s, kind);
  return content;
}

void draw_curves_panel(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Curves", rectangle, ImGuiWindowFlags_NoScrollbar);
  if (!context.snapshot.loaded()) return;
  const std::size_t plots = rectangle.width < context.style.px(520) ? 1 : 2;
  const double margin = context.style.px(14), top = context.style.px(8), width = rectangle.width / double(plots);
  for (std::size_t plot = 0; plot < plots; ++plot) {
    const Rectangle place{rectangle.x + double(plot) * width + margin, rectangle.y + top, width - margin,
                          rectangle.height - top - context.style.px(6)};
    ChartContent content = curve_content(context.snapshot, context.window.curves[plot]);
    ImGui::PushFont(context.style.semi_bold);
    content.title = shortened(content.title, float(place.width) - context.style.px(40));  // beside the choice
    ImGui::PopFont();
    draw_plot(context.style, content, place);
    draw_choice(context, plot, place);
  }
}

}  // namespace nextview

#include "ui/panels/curves_panel.hpp"

#include <fmt/format.h>

#include <array>
#include <functional>

#include "core/setting/length_text.hpp"
#include "ui/commands/window_commands.hpp"
#include "ui/panels/plot.hpp"

namespace nextview {
namespace {

constexpr std::array kind_names = {"entropy", "coverage", "divergence", "gain", "time"};

struct Curve {
  const char* name;
  std::function<double(const StepRecord&)> value;
};

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

void add_curves(ChartContent& content, const SessionSnapshot& s, const std::vector<Curve>& curves,
                std::optional<double> at_start = {}) {
  for (const Curve& curve : curves) {
    ChartSeries series{curve.name, {}, {}};
    if (at_start) {
      series.x.push_back(0);
      series.y.push_back(*at_start);
    }
    for (const StepRecord& r : s.records) {
      series.x.push_back(r.step);
      series.y.push_back(curve.value(r));
    }
    content.series.push_back(std::move(series));
  }
  // Of others the first curve alone: all of them would be a tangle.
  const auto add_other = [&](ChartSeries series, const auto& records) {
    for (std::size_t k = 0; k < records.size(); ++k) {
      series.x.push_back(double(k + 1));
      series.y.push_back(curves.front().value(records[k]));
    }
    content.series.push_back(std::move(series));
  };
  const std::string compared = s.compared ? s.compared->branch : "";
  if (s.compared)
    add_other({fmt::format("'{}', {}", compared, curves.front().name), {}, {}}, s.compared->snapshot->records);
  for (const auto& [name, records] : other_branches(s, compared)) add_other({name, {}, {}, true}, records);
  if (!s.earlier_runs) return;
  for (const Run& run : *s.earlier_runs) add_other({run.name, {}, {}, true}, run.records);
}

ChartContent entropy_content(const SessionSnapshot& s) {
  ChartContent content{"Entropy of the map [Mbit]", "view", "", "entropy", "Mbit", {}, {}, true};
  add_curves(content, s,
             {{"unmeasured (Eq. 18)", [](const StepRecord& r) { return r.entropy / 1e6; }},
              {"total, ΣH(p)", [](const StepRecord& r) { return r.total_entropy / 1e6; }}},
             double(s.grid.voxel_count()) / 1e6);
  return content;
}

/// What all frames of a recording show, by this order of them and by others.
ChartContent recorded_coverage_content(const SessionSnapshot& s) {
  ChartContent content{fmt::format("Of what all frames show, within {} [%]", length_text(s.setup->recorded->d_reg())),
                       "view",
                       "",
                       "coverage",
                       "%",
                       {},
                       100.0,
                       true};
  if (!s.orders) return content;
  const auto add = [&](const char* name, const std::vector<double>& shares) {
    ChartSeries series{name, {}, {}};
    for (std::size_t k = 0; k < shares.size(); ++k) {
      series.x.push_back(double(k + 1));
      series.y.push_back(100.0 * shares[k]);
    }
    content.series.push_back(std::move(series));
  };
  add("planned", s.orders->planned);
  add("as recorded", s.orders->recorded);
  add("random", s.orders->random);
  return content;
}

ChartContent coverage_content(const SessionSnapshot& s) {
  ChartContent content{fmt::format("Surface within {:g} mm of a point [%]", 1e3 * s.configuration.evaluation.d_reg),
                       "view",
                       "",
                       "coverage",
                       "%",
                       {},
                       100.0,
                       true};
  add_curves(content, s,
             {{"of visible surface", [](const StepRecord& r) { return 100 * r.coverage_visible; }},
              {"of all surface", [](const StepRecord& r) { return 100 * r.coverage; }}},
             0.0);
  return content;
}

ChartContent divergence_content(const SessionSnapshot& s) {
  ChartContent content{"D_KL to the truth, visited voxels [knats]", "view", "", "D_KL", "knats", {}, {}, true};
  add_curves(content, s, {{"conventional map", [](const StepRecord& r) { return r.quality.divergence / 1e3; }}});
  return content;
}

/// What a planner expects of a view can be seen in one unit only if that is the surface's; else beside Eq. 12.
ChartContent gain_content(const SessionSnapshot& s) {
  if (s.gain_unit == "cm²") {
    ChartContent surface{"New surface of a view [cm²]", "view", "", "new surface", "cm²", {}, {}, true};
    add_curves(surface, s,
               {{"seen", [](const StepRecord& r) { return r.new_surface; }},
                {"expected", [](const StepRecord& r) { return r.gain; }}});
    return surface;
  }
  const std::string unit = s.gain_unit.empty() ? "" : fmt::format(" [{}]", s.gain_unit);
  ChartContent content{"Gain predicted" + unit + " and realised [nats]", "view", "", "gain", "", {}, {}, true};
  add_curves(content, s,
             {{"realised (Eq. 12)", [](const StepRecord& r) { return r.realised_gain; }},
              {"predicted", [](const StepRecord& r) { return r.gain; }}});
  return content;
}

ChartContent time_content(const SessionSnapshot& s) {
  ChartContent content{"Time of a step [s]", "view", "", "time", "s", {}, {}, true};
  add_curves(content, s,
             {{"score", [](const StepRecord& r) { return r.seconds.score; }},
              {"insert", [](const StepRecord& r) { return r.seconds.insert; }},
              {"sense, clean", [](const StepRecord& r) { return r.seconds.sense + r.seconds.clean; }},
              {"evaluate", [](const StepRecord& r) { return r.seconds.evaluate; }},
              {"refine", [](const StepRecord& r) { return r.seconds.refine; }}});
  return content;
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

ChartContent curve_content(const SessionSnapshot& s, CurveKind kind) {
  if (kind == CurveKind::coverage && s.is_recording()) return recorded_coverage_content(s);
  const bool needs_truth = kind == CurveKind::coverage || kind == CurveKind::divergence;
  if (needs_truth && !s.is_evaluated())
    return {s.configuration.evaluation.enabled ? "The true surface is not known"
                                               : "The true surface is not looked at: evaluation is off",
            "view",
            "",
            "",
            "",
            {},
            {},
            true};
  switch (kind) {
    case CurveKind::coverage:
      return coverage_content(s);
    case CurveKind::divergence:
      return divergence_content(s);
    case CurveKind::gain:
      return gain_content(s);
    case CurveKind::time:
      return time_content(s);
    case CurveKind::entropy:
      break;
  }
  return entropy_content(s);
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

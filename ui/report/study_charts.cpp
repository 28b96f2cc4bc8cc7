#include "ui/report/study_charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ui/report/study_chart_parts.hpp"

namespace nextview {
namespace {

/// Sums over the runs of one method under one setting.
struct Times {
  std::string part, sensor, method;
  int views = 0;
  double runs = 0.0;
  StageSeconds sum;
};

std::vector<Times> times_of(std::span<const TimingRow> timings) {
  std::vector<Times> all;
  for (const TimingRow& row : timings) {
    const auto same = [&](const Times& t) {
      return t.part == row.part && t.sensor == row.sensor && t.views == row.views && t.method == row.method;
    };
    auto found = std::ranges::find_if(all, same);
    if (found == all.end()) found = all.insert(all.end(), {row.part, row.sensor, row.method, row.views, 0.0, {}});
    found->runs += 1.0;
    const StageSeconds& s = row.seconds.stages;
    found->sum.sense += s.sense, found->sum.clean += s.clean, found->sum.insert += s.insert;
    found->sum.refine += s.refine, found->sum.score += s.score, found->sum.evaluate += s.evaluate;
  }
  std::ranges::stable_sort(all, {}, [](const Times& t) { return std::tuple(t.part, t.sensor, t.views); });
  return all;
}

}  // namespace

std::span<const StudyFigure> study_figures() {
  static const std::vector<StudyFigure> all = {
      {"coverage_by_view",
       "Share of the visible surface with a point within d_reg, after each view; the mean over objects, start views "
       "and seeds. Bands, if any: standard deviation over the objects.",
       "policies", coverage_by_view},
      {"coverage_by_path",
       "Share of the visible surface with a point within d_reg, against the mean path of the camera at each view; the "
       "mean over objects, start views and seeds.",
       "policies", coverage_by_path},
      {"coverage_by_time",
       "Share of the visible surface with a point within d_reg, against the seconds that moves and scans take, without "
       "those of planning; the mean over objects, start views and seeds.",
       "policies", coverage_by_time},
      {"coverage_by_object",
       "Fig. 7b: mean over the views of the share of the visible surface that is covered, by policy and object.",
       "policies", coverage_by_object},
      {"gap_closed",
       "Where each plan stands between random views (0) and a greedy oracle that knows the mesh (1), by the mean "
       "coverage; means over objects first. Over 1 is a camera that is coarse beside d_reg: the oracle takes no "
       "account of "
       "gaps between points.",
       "the policies random and oracle, and another", gap_closed},
      {"entropy_by_view",
       "Fig. 7c: unmeasured entropy of the maximum-likelihood map (Eq. 18) after each view; the mean over objects.",
       "policies", entropy_by_view},
      {"predicted_and_seen",
       "New surface that a plan predicts of the view it takes, and what that view shows first; a dot an object and "
       "view, the mean over start views and seeds. On the diagonal the prediction is right.",
       "a policy that predicts new surface, as new-surface does", predicted_and_seen},
      {"divergence_by_object",
       "Fig. 7a: D_KL(p || q) to the truth over all voxels that a noise-free ray visits (Eqs. 15-16; q clamped to "
       "1e-3).",
       "maps", divergence_by_object},
      {"log_loss_by_object", "Log loss of each map near the surface, where its quality is decided.", "maps",
       log_loss_by_object},
      {"log_loss_by_sensor", "Log loss of each map near the surface by the noise and the field of view of the camera.",
       "maps", log_loss_by_sensor},
      {"openings_by_width",
       "Rows of slots and bores that a line passes through in the map, by the opening's width, and rows called open "
       "through solid wall beside them.",
       "maps of an object whose openings are known, as slotted_plate", openings_by_width},
      {"openings_by_sensor",
       "Rows of slots and bores that a line passes through in the map, by the noise and the field of view of the "
       "camera.",
       "maps of an object whose openings are known, as slotted_plate", openings_by_sensor},
      {"reliability",
       "How many of the voxels to which a map gives a probability the surface does touch; on the diagonal it is right.",
       "maps", reliability},
      {"stationarity",
       "Gibbs chains from several starts and with several priors: how far the log-posterior is from where it ends, and "
       "what each sweep still changes of the running mean.",
       "a map gibbs", stationarity},
  };
  return all;
}

TimeTable time_table(std::span<const TimingRow> timings) {
  TimeTable table{{"part", "sensor", "views", "method", "runs", "sense", "clean", "insert", "refine", "score", "all"},
                  {}};
  for (const Times& t : times_of(timings)) {
    const double views = t.runs * t.views;
    const auto cell = [&](double seconds) { return fmt::format("{:.3f}", seconds / views); };
    const StageSeconds& s = t.sum;
    table.rows.push_back({t.part, in_words(t.sensor), fmt::format("{}", t.views), in_words(t.method),
                          fmt::format("{:g}", t.runs), cell(s.sense), cell(s.clean), cell(s.insert), cell(s.refine),
                          cell(s.score), cell(s.sense + s.clean + s.insert + s.refine + s.score)});
  }
  return table;
}

std::string csv_text(const TimeTable& table) {
  std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
  for (const auto& row : table.rows) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

std::string markdown_text(const TimeTable& table) {
  std::string text = fmt::format("| {} |\n|", fmt::join(table.columns, " | "));
  for (std::size_t i = 0; i < table.columns.size(); ++i) text += "---|";
  text += "\n";
  for (const auto& row : table.rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text;
}

std::string latex_text(const TimeTable& table) {
  std::string text = "\\begin{tabular}{lllr" + std::string(table.columns.size() - 4, 'r') + "}\n\\hline\n";
  const auto line = [&](const std::vector<std::string>& cells) {
    return fmt::format("{} \\\\\n", fmt::join(cells, " & "));
  };
  text += line(table.columns) + "\\hline\n";
  for (const auto& row : table.rows) text += line(row);
  return text + "\\hline\n\\end{tabular}\n";
}

}  // namespace nextview

#include <fmt/format.h>

#include <cmath>

#include "core/file/counted.hpp"
#include "core/gain/gain.hpp"
#include "core/offline/session_scores.hpp"
#include "core/planner/rank_correlation.hpp"
#include "ui/report/scene_panel.hpp"

namespace nextview {
namespace {

/// The values of one gain, over the candidates that all of them value.
std::vector<std::vector<double>> by_gain(const SceneScores& scores) {
  std::vector<std::vector<double>> values(scores.gains.size());
  for (const ViewScore& view : scores.views) {
    if (std::ranges::any_of(view.gains, [](double gain) { return !std::isfinite(gain); })) continue;
    for (std::size_t g = 0; g < values.size(); ++g) values[g].push_back(view.gains[g]);
  }
  return values;
}

}  // namespace

VectorDrawing gain_agreement_figure(std::span<ReportScan> scans, const FigurePaper& paper) {
  ReportScan& scan = scans.front();
  const std::size_t views = (scan.states.size() + 2) / 3;
  scan.session->restore(scan.states.at(views - 1));
  std::vector<std::string> names = {"new-surface"};
  for (const Gain& gain : gains()) names.emplace_back(gain.name);
  const auto values = by_gain(score_session(*scan.session, names));
  MatrixPlot plot;
  plot.title = fmt::format("How alike gains rank {} candidates: {} after {}", values.front().size(), scan.name,
                           counted(views, "view"));
  plot.note =
      "Spearman's rank correlation. Red: alike; grey: they have nothing to do with each other; blue: in opposite order";
  plot.diverging = true;
  plot.digits = 2;
  plot.low = -1.0, plot.high = 1.0;
  plot.rows = plot.columns = names;
  for (const auto& row : values) {
    plot.values.emplace_back();
    for (const auto& column : values) plot.values.back().push_back(rank_correlation(row, column));
  }
  const double height = 120 + 30.0 * double(names.size());
  VectorDrawing drawing(1020, height, paper.look);
  draw_matrix(drawing, {0, 0, 1020, height}, plot);
  return drawing;
}

}  // namespace nextview

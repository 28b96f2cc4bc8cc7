#include "ui/figures/calibration_figure.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ui/charts/curve_plot.hpp"
#include "ui/figures/calibration_table.hpp"

namespace nextview {
namespace {

/// The panel in a column (0 to 2) of the upper row, and the table beneath.
struct CalibrationLayout {
  double width, top, table_height, plot_width;

  CalibrationLayout(double page_width, double rows_top, std::size_t examples)
      : width(page_width),
        top(rows_top),
        table_height(std::min(0.6 * rows_top, 40.0 * double(examples) + 118.0)),
        plot_width(std::floor((page_width - 4 * page_margin) / 3)) {}

  PageArea plot(int column) const {
    const double bottom = table_height + 2 * page_margin;
    return {page_margin + column * (plot_width + page_margin), bottom, plot_width, top - page_margin - bottom};
  }
  PageArea table() const { return {page_margin, page_margin, width - 2 * page_margin, table_height}; }
};

CurvePlot descent_plot(const Calibration& fit) {
  CurvePlot plot;
  plot.title = "Descent (BFGS)";
  plot.remark = fit.converged ? "converged" : "not converged";
  plot.x_label = "iteration";
  plot.y_label = "cross entropy [nats per voxel]";
  plot.whole_x = true;
  Curve curve{"", {}, {}, {}, calibration_after};
  for (std::size_t i = 0; i < fit.descent.size(); ++i) {
    curve.x.push_back(double(i));
    curve.y.push_back(fit.descent[i].cross_entropy);
  }
  plot.x_high = std::max(1.0, double(fit.descent.size()) - 1.0);
  if (!curve.y.empty()) {
    const auto [low, high] = std::minmax_element(curve.y.begin(), curve.y.end());
    const double margin = std::max(1e-3, 0.08 * (*high - *low));
    plot.y_low = std::max(0.0, *low - margin);
    plot.y_high = *high + margin;
  }
  plot.curves = {curve};
  return plot;
}

/// What a voxel's probability becomes by one update after the other of the same kind, 1 m away.
Curve repeated(const std::string& name, const InverseSensorModel& model, double term, const Colour& colour) {
  constexpr int updates = 10;
  Curve curve{name, {}, {}, {}, colour};
  double sum = 0.0;
  for (int n = 0; n <= updates; ++n) {
    curve.x.push_back(n);
    curve.y.push_back(probability(sum));
    sum = std::clamp(sum + term, log_odds(model.clamp_min), log_odds(model.clamp_max));
  }
  return curve;
}

CurvePlot update_plot(const InverseSensorModel& before, const InverseSensorModel& after) {
  CurvePlot plot;
  plot.title = "Sensor model";
  plot.remark = "1 m away";
  plot.x_label = "hits (above 0.5) or misses (below) in a row";
  plot.y_label = "P(occupied)";
  plot.whole_x = true;
  plot.x_high = 10.0;
  plot.curves = {repeated("before", before, before.hit_term(1.0), calibration_before),
                 repeated("", before, before.miss_term(1.0), calibration_before),
                 repeated("after", after, after.hit_term(1.0), calibration_after),
                 repeated("", after, after.miss_term(1.0), calibration_after)};
  return plot;
}

/// The examples' bins together: held-out ones, or all if none is.
GibbsReliability together(const MapCalibration& calibration, GibbsReliability ExampleScores::*which) {
  const bool any_held_out = std::any_of(calibration.examples.begin(), calibration.examples.end(),
                                        [](const ExampleScores& e) { return e.held_out; });
  GibbsReliability sum;
  for (const ExampleScores& e : calibration.examples) {
    if (any_held_out && !e.held_out) continue;
    for (std::size_t b = 0; b < sum.size(); ++b) {
      const ReliabilityBin& bin = (e.*which)[b];
      if (bin.voxels == 0) continue;
      const double all = double(sum[b].voxels + bin.voxels), share = double(bin.voxels) / all;
      sum[b].mean_probability += share * (bin.mean_probability - sum[b].mean_probability);
      sum[b].occupied_share += share * (bin.occupied_share - sum[b].occupied_share);
      sum[b].voxels += bin.voxels;
    }
  }
  return sum;
}

Curve reliability_curve(const std::string& name, const GibbsReliability& bins, const Colour& colour) {
  Curve curve{name, {}, {}, {}, colour};
  for (const ReliabilityBin& bin : bins)
    if (bin.voxels > 0) {
      curve.x.push_back(bin.mean_probability);
      curve.y.push_back(bin.occupied_share);
    }
  return curve;
}

CurvePlot reliability_plot(const MapCalibration& calibration) {
  CurvePlot plot;
  plot.title = "Agreement with the Gibbs map";
  const bool any_held_out = std::any_of(calibration.examples.begin(), calibration.examples.end(),
                                        [](const ExampleScores& e) { return e.held_out; });
  plot.remark = any_held_out ? "held-out objects" : "fitted objects";
  plot.x_label = "P(occupied) of the conventional map";
  plot.y_label = "mean P(occupied) of the Gibbs map";
  plot.curves = {
      {"equal", {}, {0.0, 1.0}, {0.0, 1.0}, theme::hairline},
      reliability_curve("before", together(calibration, &ExampleScores::reliability_before), calibration_before),
      reliability_curve("after", together(calibration, &ExampleScores::reliability_after), calibration_after)};
  return plot;
}

}  // namespace

Image draw_calibration_figure(const MapCalibration& calibration, int width, int height) {
  if (calibration.examples.empty()) throw std::invalid_argument("calibration figure: there is no example");
  const Calibration& fit = calibration.fit;
  const auto numbers = [](const InverseSensorModel& m) {
    std::string text =
        fmt::format("hit {:.3g}, miss {:.3g}, clamps {:.3g} and {:.3g}", m.hit, m.miss, m.clamp_min, m.clamp_max);
    if (m.range_dependent()) text += fmt::format(", decays {:.3g} and {:.3g} 1/m", m.hit_decay, m.miss_decay);
    return text;
  };
  return draw_page(width, height, [&](vtkContext2D& context) {
    Painter painter(context);
    const double top =
        height - paint_title(painter, width, height, "The conventional map, calibrated to the Gibbs map",
                             fmt::format("cross entropy {:.4f} before, {:.4f} after [nats per voxel]",
                                         fit.cross_entropy_before, fit.cross_entropy),
                             fmt::format("Before: {}. After: {}.", numbers(calibration.before), numbers(fit.model)));
    const CalibrationLayout layout(width, top, calibration.examples.size());
    paint_curve_plot(context, layout.plot(0), descent_plot(fit));
    paint_curve_plot(context, layout.plot(1), update_plot(calibration.before, fit.model));
    paint_curve_plot(context, layout.plot(2), reliability_plot(calibration));
    paint_calibration_table(painter, layout.table(), calibration);
  });
}

}  // namespace nextview

#include "ui/figures/calibration_figure.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ui/figures/curve_plot.hpp"

namespace nextview {
namespace {

constexpr Colour before_colour = theme::visited, after_colour = theme::series[0], gibbs_colour = theme::series[1];

/// The panel in a column (0 to 2) of the upper row, and the table beneath.
struct Layout {
  double width, top, table_height, plot_width;

  Layout(double page_width, double rows_top, std::size_t examples)
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
  plot.y_label = "cross entropy [nats a voxel]";
  plot.whole_x = true;
  Curve curve{"", {}, {}, {}, after_colour};
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
  plot.curves = {repeated("before", before, before.hit_term(1.0), before_colour),
                 repeated("", before, before.miss_term(1.0), before_colour),
                 repeated("after", after, after.hit_term(1.0), after_colour),
                 repeated("", after, after.miss_term(1.0), after_colour)};
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
  plot.curves = {{"equal", {}, {0.0, 1.0}, {0.0, 1.0}, theme::hairline},
                 reliability_curve("before", together(calibration, &ExampleScores::reliability_before), before_colour),
                 reliability_curve("after", together(calibration, &ExampleScores::reliability_after), after_colour)};
  return plot;
}

/// One of a table's groups of three numbers: before, after, Gibbs.
struct Columns {
  double before, after, gibbs;  ///< right ends [px]
};

class Table {
 public:
  Table(Painter& painter, const PageArea& area, const MapCalibration& calibration)
      : painter_(painter), area_(area), calibration_(calibration) {
    for (const ExampleScores& e : calibration.examples)
      for (const auto* scores : {&e.before, &e.after, &e.gibbs})
        if (*scores) largest_ = std::max(largest_, (*scores)->touch_band.log_loss);
  }

  void paint() {
    paint_panel(painter_, area_, "Before and after, object by object", "near: within 3 voxels of the surface");
    double y = area_.top() - heading_height - 18;
    group("cross entropy to the Gibbs map [nats]", entropy_, y);
    group("log loss near the true surface [nats]", loss_, y);
    group("open rows of slots and bores [%]", open_, y);
    y -= 22;
    for (const Columns* c : {&entropy_, &loss_, &open_}) {
      heading(c->before, "before", y);
      heading(c->after, "after", y);
      heading(c->gibbs, c == &entropy_ ? "least" : "Gibbs", y);
    }
    if (largest_ > 0.0) legend(y);
    const double room = y - area_.bottom - page_margin;
    const double row = std::min(40.0, room / double(std::max<std::size_t>(1, calibration_.examples.size())));
    for (const ExampleScores& e : calibration_.examples) {
      painter_.line(left(), y - 8, right(), y - 8, 1, theme::hairline);
      y -= row;
      paint_row(e, y + 0.5 * row - 14);
    }
  }

 private:
  double left() const { return area_.left + page_margin; }
  double right() const { return area_.right() - page_margin; }

  void heading(double x, const std::string& text, double y) {
    painter_.text(x, y, text, theme::small_text, theme::soft_ink, TextWeight::regular, TextAlign::right);
  }
  void group(const std::string& text, const Columns& columns, double y) {
    painter_.text(columns.gibbs, y, text, theme::small_text, theme::ink, TextWeight::semi_bold, TextAlign::right);
  }
  void numbers(const Columns& c, const std::array<std::string, 3>& text, double y) {
    painter_.text(c.before, y, text[0], theme::text, theme::ink, TextWeight::regular, TextAlign::right);
    painter_.text(c.after, y, text[1], theme::text, theme::ink, TextWeight::semi_bold, TextAlign::right);
    painter_.text(c.gibbs, y, text[2], theme::text, theme::ink, TextWeight::regular, TextAlign::right);
  }

  void paint_row(const ExampleScores& e, double y) {
    painter_.text(left(), y, fmt::format("{}, {} views", e.name, e.views), theme::text, theme::ink);
    painter_.text(left() + 236, y, e.held_out ? "held out" : "fitted", theme::small_text,
                  e.held_out ? after_colour : theme::soft_ink, TextWeight::regular);
    const auto of = [](const std::optional<MapScores>& s, auto value) {
      const std::optional<double> number = s ? value(*s) : std::nullopt;
      return number;
    };
    const auto text = [](const std::optional<double>& number, int decimals) {
      return number ? fmt::format("{:.{}f}", *number, decimals) : std::string("–");
    };
    const auto loss = [&](const auto& s) {
      return of(s, [](const MapScores& m) { return std::optional(m.touch_band.log_loss); });
    };
    const auto open = [&](const auto& s) {
      return of(s, [](const MapScores& m) {
        const auto share = m.openings.row_openness();
        return share ? std::optional(100.0 * *share) : std::nullopt;
      });
    };
    numbers(entropy_, {text(e.cross_entropy_before, 3), text(e.cross_entropy_after, 3), text(e.gibbs_entropy, 3)}, y);
    numbers(loss_, {text(loss(e.before), 3), text(loss(e.after), 3), text(loss(e.gibbs), 3)}, y);
    numbers(open_, {text(open(e.before), 0), text(open(e.after), 0), text(open(e.gibbs), 0)}, y);
    if (!e.before) return;
    const double middle = y + 5;
    painter_.line(at(0.0), middle, at(largest_), middle, 1, theme::hairline);
    painter_.line(at(*loss(e.before)), middle, at(*loss(e.after)), middle, 3, theme::hairline);
    mark(*loss(e.before), middle, before_colour, 10, 12);
    mark(*loss(e.after), middle, after_colour, 10, 12);
    mark(*loss(e.gibbs), middle, gibbs_colour, 3, 20);
  }

  /// Of a log loss, along the row.
  double at(double log_loss) const { return bars_left_ + 220.0 * log_loss / largest_; }
  void mark(double log_loss, double middle, const Colour& colour, double width, double height) {
    painter_.box(at(log_loss) - 0.5 * width, middle - 0.5 * height, width, height, colour);
  }
  void legend(double y) {
    painter_.text(at(0.0), y, "0", theme::small_text, theme::soft_ink, TextWeight::regular, TextAlign::centre);
    painter_.text(at(largest_), y, fmt::format("{:.2f} nats", largest_), theme::small_text, theme::soft_ink,
                  TextWeight::regular, TextAlign::centre);
    double x = bars_left_;
    for (const auto& [text, colour] :
         {std::pair{"before", before_colour}, {"after", after_colour}, {"Gibbs", gibbs_colour}}) {
      painter_.box(x, y + 22, 10, 10, colour);
      painter_.text(x + 16, y + 22, text, theme::small_text, theme::ink);
      x += 30 + painter_.text_width(text, theme::small_text);
    }
  }

  Painter& painter_;
  PageArea area_;
  const MapCalibration& calibration_;
  double largest_ = 0.0;
  const Columns entropy_{520, 600, 680}, loss_{850, 930, 1010}, open_{1400, 1480, 1560};
  const double bars_left_ = 1050;
};

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
                             fmt::format("cross entropy {:.4f} before, {:.4f} after [nats a voxel]",
                                         fit.cross_entropy_before, fit.cross_entropy),
                             fmt::format("Before: {}. After: {}.", numbers(calibration.before), numbers(fit.model)));
    const Layout layout(width, top, calibration.examples.size());
    paint_curve_plot(context, layout.plot(0), descent_plot(fit));
    paint_curve_plot(context, layout.plot(1), update_plot(calibration.before, fit.model));
    paint_curve_plot(context, layout.plot(2), reliability_plot(calibration));
    Table(painter, layout.table(), calibration).paint();
  });
}

}  // namespace nextview

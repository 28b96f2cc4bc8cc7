#include "ui/figures/calibration_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace nextview {
namespace {

constexpr Colour gibbs_colour = theme::series[1];

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
                  e.held_out ? calibration_after : theme::soft_ink, TextWeight::regular);
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
    mark(*loss(e.before), middle, calibration_before, 10, 12);
    mark(*loss(e.after), middle, calibration_after, 10, 12);
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
         {std::pair{"before", calibration_before}, {"after", calibration_after}, {"Gibbs", gibbs_colour}}) {
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

void paint_calibration_table(Painter& painter, const PageArea& panel, const MapCalibration& calibration) {
  Table(painter, panel, calibration).paint();
}

}  // namespace nextview

#include "ui/charts/curve_names.hpp"

namespace nextview {

double paint_curve_names(Painter& painter, double left, double top, double width, std::span<const CurveName> names) {
  constexpr double row = 22, between = 20;
  double x = left, y = top - row;
  for (const auto& [name, colour] : names) {
    if (name.empty()) continue;
    const double needed = curve_sample + curve_sample_gap + painter.text_width(name, theme::small_text);
    if (x > left && x + needed > left + width) x = left, y -= row;
    painter.line(x, y + 7, x + curve_sample, y + 7, 2, colour);
    painter.text(x + curve_sample + curve_sample_gap, y, name, theme::small_text, theme::ink);
    x += needed + between;
  }
  return top - y;
}

}  // namespace nextview

#include "ui/report/surface_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ui/appearance/colour_map.hpp"

namespace nextview {
namespace {

using Point = Eigen::Vector2d;

/// A cabinet of three axes: x to the lower right, y to the upper right, z up; all from 0 to 1.
struct Cabinet {
  Point origin, x_way, y_way, z_way;

  explicit Cabinet(const DrawingArea& area) {
    origin = {area.left + 0.10 * area.width, area.top + 0.74 * area.height};
    x_way = {0.46 * area.width, 0.15 * area.height};
    y_way = {0.38 * area.width, -0.20 * area.height};
    z_way = {0.0, -0.44 * area.height};
  }
  Point at(double x, double y, double z) const { return origin + x * x_way + y * y_way + z * z_way; }
};

std::string tick(double value) { return fmt::format("{:g}", value); }

void draw_axes(VectorDrawing& d, const SurfacePlot& plot, const Cabinet& c) {
  const Look& look = d.look();
  const auto edge = [&](const Point& a, const Point& b) { d.line({a, b}, look.hairline); };
  for (const double at : {0.0, 0.5, 1.0}) {
    edge(c.at(at, 0, 0), c.at(at, 1, 0)), edge(c.at(0, at, 0), c.at(1, at, 0));
    edge(c.at(0, 0, at), c.at(0, 1, at)), edge(c.at(0, 1, at), c.at(1, 1, at));
    const auto text = [&](const Point& p, double dx, double dy, double low, double high, TextAlign align) {
      d.text(p.x() + dx, p.y() + dy, tick(low + at * (high - low)), theme::small_text, look.soft_ink, align);
    };
    text(c.at(at, 0, 0), -4, 18, plot.x_low, plot.x_high, TextAlign::right);
    text(c.at(1, at, 0), 10, 14, plot.y_low, plot.y_high, TextAlign::left);
    text(c.at(0, 0, at), -6, 4, 0.0, plot.z_high, TextAlign::right);
  }
  const Point x = c.at(0.5, 0, 0), y = c.at(1, 0.5, 0), z = c.at(0, 0, 1);
  d.text(x.x() - 24, x.y() + 40, plot.x_label, theme::small_text, look.soft_ink, TextAlign::centre);
  d.text(y.x() + 30, y.y() + 34, plot.y_label, theme::small_text, look.soft_ink, TextAlign::centre);
  d.text(z.x() - 20, z.y() - 14, plot.z_label, theme::small_text, look.soft_ink);
}

}  // namespace

void draw_surface_plot(VectorDrawing& d, const DrawingArea& area, const SurfacePlot& plot) {
  d.text(area.left, area.top + 12, plot.title, theme::text, d.look().ink, TextAlign::left, true);
  d.text(area.left, area.top + 30, plot.note, theme::small_text, d.look().soft_ink);
  const Cabinet c(area);
  draw_axes(d, plot, c);
  const auto height = [&](int i, int k) {
    const double x = plot.x_low + (plot.x_high - plot.x_low) * i / plot.steps;
    const double y = plot.y_low + (plot.y_high - plot.y_low) * k / plot.steps;
    return std::clamp(plot.value(x, y) / plot.z_high, 0.0, 1.0);
  };
  const auto place = [&](int i, int k) { return c.at(double(i) / plot.steps, double(k) / plot.steps, height(i, k)); };
  for (int k = plot.steps - 1; k >= 0; --k)  // what is farther off first
    for (int i = 0; i < plot.steps; ++i) {
      const double mean = 0.25 * (height(i, k) + height(i + 1, k) + height(i, k + 1) + height(i + 1, k + 1));
      const Colour colour = ColourMap::score().at(mean);
      const std::vector<Point> corners = {place(i, k), place(i + 1, k), place(i + 1, k + 1), place(i, k + 1)};
      d.area(corners, colour);
      d.line({corners[0], corners[1]}, mix(colour, theme::ink, 0.25), 0.5);
    }
}

}  // namespace nextview

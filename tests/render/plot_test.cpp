// Curves over two axes, by the shapes that they are drawn with.
#include "ui/report/plot.hpp"

#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <sstream>

namespace nextview {
namespace {

/// The corners of each shape of a kind in an SVG ("polygon" or "polyline"), in the order in which they are drawn.
std::vector<std::vector<Eigen::Vector2d>> shapes(const std::string& svg, const std::string& kind,
                                                 const std::string& with) {
  std::vector<std::vector<Eigen::Vector2d>> all;
  const std::regex shape("<" + kind + " [^>]*>"), points("points=\"([^\"]*)\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), shape), end; at != end; ++at) {
    const std::string text = at->str();
    std::smatch found;
    if (text.find(with) == text.npos || !std::regex_search(text, found, points)) continue;
    std::string numbers = found[1];
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    std::istringstream stream(numbers);
    auto& corners = all.emplace_back();
    for (double x = 0, y = 0; stream >> x >> y;) corners.emplace_back(x, y);
  }
  return all;
}

std::string svg_of(const Plot& plot) {
  VectorDrawing drawing(700, 400, Look::light());
  draw_plot(drawing, {0, 0, 700, 400}, plot);
  return drawing.svg();
}

/// Where the numbers at the axes stand: of each anchor ("middle": x, "end": y) the number and its place along the axis.
std::map<double, double> ticks(const std::string& svg, const std::string& anchor) {
  std::map<double, double> all;
  const std::regex tick("<text x=\"([^\"]*)\" y=\"([^\"]*)\"[^>]* text-anchor=\"" + anchor + "\">([-0-9.e+]+)</text>");
  for (std::sregex_iterator at(svg.begin(), svg.end(), tick), end; at != end; ++at)
    all[std::stod((*at)[3])] = std::stod((*at)[anchor == "end" ? 2 : 1]);
  return all;
}

/// The values at places of the drawing, by what stands at the ends of the axes.
class Values {
 public:
  explicit Values(const std::string& svg) : x_(ticks(svg, "middle")), y_(ticks(svg, "end")) {}
  std::vector<Eigen::Vector2d> of(const std::vector<Eigen::Vector2d>& places) const {
    std::vector<Eigen::Vector2d> values;
    // A number's baseline is 4 px beneath its tick, so that the two are level.
    for (const Eigen::Vector2d& p : places) values.emplace_back(value(x_, p.x()), value(y_, p.y() + 4));
    return values;
  }

 private:
  static double value(const std::map<double, double>& ticks, double place) {
    const auto [first, at_first] = *ticks.begin();
    const auto [last, at_last] = *ticks.rbegin();
    return first + (place - at_first) / (at_last - at_first) * (last - first);
  }
  std::map<double, double> x_, y_;
};

void expect_at(const std::vector<Eigen::Vector2d>& values, const std::vector<Eigen::Vector2d>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  // Places are written to a hundredth of a pixel, and a unit is some 30 px here.
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_LT((values[i] - expected[i]).cwiseAbs().maxCoeff(), 0.01) << i << ": " << values[i].transpose();
}

/// From 0 to 10 both ways.
Plot plot_of(std::vector<PlotSeries> series) {
  Plot plot;
  plot.series = std::move(series);
  plot.x_low = plot.y_low = 0.0;
  plot.x_high = plot.y_high = 10.0;
  return plot;
}

TEST(Plot, ABandGoesFromSpreadBeneathToSpreadAbove) {
  const std::string svg = svg_of(plot_of({{"", {0, 4, 10}, {5, 6, 2}, {1, 2, 0.5}}}));
  const Values values(svg);
  const auto bands = shapes(svg, "polygon", "fill-opacity");
  ASSERT_EQ(bands.size(), 2u) << "from each value to the next";
  expect_at(values.of(bands[0]), {{0, 6}, {4, 8}, {4, 4}, {0, 4}});
  expect_at(values.of(bands[1]), {{4, 8}, {10, 2.5}, {10, 1.5}, {4, 4}});
  const auto lines = shapes(svg, "polyline", "stroke-width=\"2\"");
  ASSERT_EQ(lines.size(), 1u);
  expect_at(values.of(lines[0]), {{0, 5}, {4, 6}, {10, 2}});
}

TEST(Plot, WithoutSpreadsThereIsNoBand) {
  EXPECT_TRUE(shapes(svg_of(plot_of({{"", {0, 4, 10}, {5, 6, 2}}})), "polygon", "fill-opacity").empty());
  const std::string svg = svg_of(plot_of({{"", {0, 4, 10}, {5, 6, 2}, {1}}}));
  const auto bands = shapes(svg, "polygon", "fill-opacity");
  ASSERT_EQ(bands.size(), 2u);
  expect_at(Values(svg).of(bands[0]), {{0, 6}, {4, 6}, {4, 6}, {0, 4}});  // values without one have none
}

TEST(Plot, TheDiagonalIsWhereBothValuesAreTheSame) {
  Plot plot = plot_of({{"", {0, 10}, {5, 6}}});
  EXPECT_TRUE(shapes(svg_of(plot), "polyline", "dasharray").empty()) << "it was not asked for";
  plot.diagonal = true;
  const auto diagonal = [&] {
    const std::string svg = svg_of(plot);
    const auto lines = shapes(svg, "polyline", "dasharray");
    EXPECT_EQ(lines.size(), 1u);
    return lines.empty() ? std::vector<Eigen::Vector2d>() : Values(svg).of(lines.front());
  };
  expect_at(diagonal(), {{0, 0}, {10, 10}});
  plot.y_high = 6.0;
  expect_at(diagonal(), {{0, 0}, {6, 6}});
  plot.x_low = 4.0;
  expect_at(diagonal(), {{4, 4}, {6, 6}});
}

TEST(Plot, PowersOfTenAreEquallyFarApartOnALogarithmicAxis) {
  Plot plot = plot_of({{"", {0, 5, 10}, {1, 10, 100}}});
  plot.logarithmic_y = true;
  plot.y_low = 1.0, plot.y_high = 100.0;
  const std::string svg = svg_of(plot);
  const auto lines = shapes(svg, "polyline", "stroke-width=\"2\"");
  ASSERT_EQ(lines.size(), 1u);
  const auto& p = lines.front();
  EXPECT_NEAR(p[0].y() - p[1].y(), p[1].y() - p[2].y(), 0.05);
  EXPECT_GT(p[0].y() - p[1].y(), 30) << "more is higher up";
  const auto y = ticks(svg, "end");
  for (const double power : {1.0, 10.0, 100.0}) ASSERT_TRUE(y.contains(power)) << power;
  EXPECT_NEAR(y.at(10.0) - 4, p[1].y(), 0.05);
}

TEST(Plot, NamesStandBesideTheEndsOfTheirCurvesWithoutTouching) {
  const std::string svg =
      svg_of(plot_of({{"low", {0, 10}, {0, 5.0}}, {"high", {0, 10}, {0, 5.1}}, {"apart", {0, 10}, {0, 9}}}));
  const auto place = [&](const std::string& name) {
    std::smatch found;
    EXPECT_TRUE(std::regex_search(svg, found, std::regex("<text x=\"[^\"]*\" y=\"([^\"]*)\"[^>]*>" + name + "<")));
    return std::stod(found[1]);
  };
  EXPECT_LT(place("high"), place("low") - theme::small_text) << "above it, a line apart";
  const Values values(svg);
  EXPECT_NEAR(values.of({{0, place("apart") - 4}})[0].y(), 9, 0.3);
  EXPECT_NEAR(values.of({{0, place("high") - 4}})[0].y(), 5, 1.0);
  EXPECT_NEAR(values.of({{0, place("low") - 4}})[0].y(), 5, 1.0);
}

}  // namespace
}  // namespace nextview

// Curves and charts by their pixels: what is named stands where it is to, and each series has its colour.
#include "ui/charts/curve_plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ui/charts/chart_page.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

constexpr int plot_width = 640, plot_height = 400, column = 200;  // of a page and of the names beside a plot [px]

Image drawn(const CurvePlot& plot) {
  return draw_page(plot_width, plot_height, [&](vtkContext2D& context) {
    paint_curve_plot(context, {0, 0, plot_width, plot_height}, plot);
  });
}

/// A curve from corner to corner.
CurvePlot rising(double names_width) {
  CurvePlot plot;
  plot.title = "t";
  plot.x_label = "x", plot.y_label = "y";
  plot.names_width = names_width;
  plot.curves = {{"name", {}, {0.0, 1.0}, {0.0, 1.0}, theme::series[0]}};
  return plot;
}

/// Where pictures differ: [first, last] column, and how many pixels.
struct Difference {
  int first = plot_width, last = -1, pixels = 0;
};
Difference difference(const Image& a, const Image& b) {
  Difference found;
  for (int y = 0; y < plot_height; ++y)
    for (int x = 0; x < plot_width; ++x) {
      const std::size_t at = (std::size_t(y) * plot_width + x) * 4;
      if (std::equal(&a.rgba[at], &a.rgba[at] + 4, &b.rgba[at])) continue;
      found.first = std::min(found.first, x), found.last = std::max(found.last, x), ++found.pixels;
    }
  return found;
}

/// The mean place of pixels of about this colour, and how many there are.
struct Spot {
  double x = 0.0, y = 0.0;
  int pixels = 0;
};
Spot spot(const Image& image, const Colour& colour) {
  Spot found;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double off = 0.0;
      for (int c = 0; c < 3; ++c)
        off = std::max(off, std::abs(image.rgba[(std::size_t(y) * image.width + x) * 4 + c] - 255.0 * colour[c]));
      if (off < 8.0) found.x += x, found.y += y, ++found.pixels;
    }
  found.x /= std::max(found.pixels, 1), found.y /= std::max(found.pixels, 1);
  return found;
}

TEST(CurvePlot, NamesAndTheirDetailsStandInTheColumnBesideIt) {
  CurvePlot plot = rising(column);
  const Image named = drawn(plot);
  plot.curves[0].name.clear();
  const Difference of_name = difference(named, drawn(plot));
  EXPECT_GT(of_name.pixels, 50) << "four letters";
  EXPECT_GE(of_name.first, plot_width - column) << "in the column";
  plot.curves[0].name = "name";
  plot.curves[0].details = {"detail"};
  const Difference of_details = difference(named, drawn(plot));
  EXPECT_GT(of_details.pixels, 50);
  EXPECT_GE(of_details.first, plot_width - column);
}

TEST(CurvePlot, NamesStandAboveItWhereThereIsNoColumn) {
  CurvePlot plot = rising(0);
  const Image named = drawn(plot);
  plot.curves[0].name = "eman";
  const Difference of_name = difference(named, drawn(plot));
  EXPECT_GT(of_name.pixels, 50);
  EXPECT_LT(of_name.last, 100) << "at the left";
  plot.curves[0].details = {"detail"};
  CurvePlot without = plot;
  without.curves[0].details.clear();
  EXPECT_EQ(difference(drawn(plot), drawn(without)).pixels, 0) << "details are for a column";
}

TEST(CurvePlot, WhatIsOutsideOfItsRangesIsCutOff) {
  CurvePlot plot = rising(0);
  plot.curves[0].x = {-1.0, 2.0}, plot.curves[0].y = {-1.0, 2.0};  // the same line, longer
  EXPECT_LT(difference(drawn(plot), drawn(rising(0))).pixels, 20);
  plot.curves[0].x = {0.0, 1.0}, plot.curves[0].y = {1.5, 1.5};
  CurvePlot none = rising(0);
  none.curves[0].x.clear(), none.curves[0].y.clear();
  EXPECT_EQ(difference(drawn(plot), drawn(none)).pixels, 0) << "a level line above it";
  plot.curves[0].y = {-0.5, -0.5};
  EXPECT_EQ(difference(drawn(plot), drawn(none)).pixels, 0) << "and below it";
}

TEST(CurvePlot, ACurveNeedsAsManyOfEach) {
  CurvePlot plot = rising(0);
  plot.curves[0].y.pop_back();
  bool refused = false;
  draw_page(plot_width, plot_height, [&](vtkContext2D& context) {
    EXPECT_THROW(paint_curve_plot(context, {0, 0, plot_width, plot_height}, plot), std::invalid_argument);
    refused = true;
  });
  EXPECT_TRUE(refused) << "nothing was painted";
}

TEST(Chart, EachSeriesIsALineInItsColour) {
  OffscreenTarget target(640, 400);
  const ChartContent content{"t",   "view", "", "coverage", "%", {{"", {0, 20}, {80, 80}}, {"", {0, 20}, {20, 20}}},
                             100.0, true};
  const Image image = draw_charts(target, std::vector{content}, {640, 400}, false);
  const Spot upper = spot(image, theme::series[0]), lower = spot(image, theme::series[1]);
  EXPECT_GT(upper.pixels, 400) << "a line across the chart";
  EXPECT_GT(lower.pixels, 400);
  EXPECT_LT(upper.y, 200);
  EXPECT_GT(lower.y, upper.y + 100) << "60 of 100 % below it";
  EXPECT_LT(spot(image, theme::series[2]).pixels, 5) << "there is no third";
}

TEST(Chart, OnALargerPageLettersAndLinesAreLarger) {
  OffscreenTarget target(64, 48);
  const ChartContent content{"Title", "view", "", "coverage", "%", {{"", {0, 20}, {20, 80}}}, 100.0, true};
  const auto ink = [&](const PictureSize& size) {
    const Image image = draw_charts(target, std::vector{content}, size, false);
    int pixels = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) pixels += image.rgba[i] < 180;  // the grid is paler
    return double(pixels);
  };
  const double usual = ink({640, 400});
  EXPECT_GT(ink({1280, 800}), 3 * usual) << "else lines are as long again, and letters as they were";
  EXPECT_LT(ink({1280, 400}), 2.5 * usual) << "what is wider alone has no room for them";
}

TEST(Page, WhatCannotBePaintedIsToldToWhoAsked) {
  for (int again = 0; again < 3; ++again)
    EXPECT_THROW(draw_page(plot_width, plot_height, [](vtkContext2D&) { throw std::invalid_argument("no"); }),
                 std::invalid_argument);
  EXPECT_EQ(drawn(rising(0)).width, plot_width) << "and the next page can be";
}

TEST(Chart, EachStandsInItsPartOfThePage) {
  OffscreenTarget target(640, 400);
  const ChartContent empty{"t", "view", "", "gain", "", {}, {}, true};
  ChartContent filled = empty;
  filled.series = {{"one", {0, 20}, {1, 1}}};
  for (std::size_t place = 0; place < 4; ++place) {
    std::vector<ChartContent> charts(4, empty);
    charts[place] = filled;
    const Spot line = spot(draw_charts(target, charts, {640, 400}, false), theme::series[0]);
    EXPECT_GT(line.pixels, 150) << place;
    EXPECT_EQ(line.x > 320, place % 2 == 1) << place;
    EXPECT_EQ(line.y > 200, place / 2 == 1) << place;
  }
}

}  // namespace
}  // namespace nextview

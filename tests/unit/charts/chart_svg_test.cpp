// Charts as SVG: well formed, a line a series, each value where the ticks say that it is.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include "ui/charts/chart_page.hpp"

namespace nextview {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Every element is closed, in its order; no bare & or < is left.
void expect_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  const std::regex tag(R"(<(/?)([a-zA-Z?]+)((?:\s+[a-zA-Z0-9-]+="[^"<]*"|\s+[a-zA-Z]+='[^']*')*)\s*([/?]?)>)");
  std::string rest = xml;
  for (std::smatch m; std::regex_search(rest, m, tag); rest = m.suffix()) {
    EXPECT_EQ(m.prefix().str().find_first_of("<>"), std::string::npos) << m.prefix();
    if (m[1] == "/") {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), m[2]);
      open.pop_back();
    } else if (m[4] == "") {
      open.push_back(m[2]);
    }
  }
  EXPECT_TRUE(open.empty());
  EXPECT_TRUE(std::regex_search(xml, std::regex("&(amp|lt|gt|quot);")));
  EXPECT_FALSE(std::regex_search(xml, std::regex("&(?!amp;|lt;|gt;|quot;)")));
}

std::vector<std::string> all(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator m(text.begin(), text.end(), regex), end; m != end; ++m) found.push_back((*m)[1]);
  return found;
}

/// Where a value is drawn, worked out from the places of the ticks' own numbers.
struct Scale {
  double pixel_a, value_a, pixel_b, value_b;
  double at(double value) const { return pixel_a + (value - value_a) / (value_b - value_a) * (pixel_b - pixel_a); }
};

Scale scale(const std::string& svg, const std::string& anchor, bool is_x) {
  const std::regex tick(R"re(<text x="([-.0-9]+)" y="([-.0-9]+)"[^>]*text-anchor=")re" + anchor +
                        R"re(">([-.0-9]+)</text>)re");
  std::vector<std::pair<double, double>> ticks;
  for (std::sregex_iterator m(svg.begin(), svg.end(), tick), end; m != end; ++m)
    ticks.emplace_back(std::stod((*m)[is_x ? 1 : 2]) - (is_x ? 0 : 4), std::stod((*m)[3]));
  return {ticks.front().first, ticks.front().second, ticks.back().first, ticks.back().second};
}

TEST(ChartSvg, EachValueLiesWhereTheTicksSay) {
  const ChartContent content{"a < b & c", "view", "",
                             "gain",      "nats", {{"one", {0, 1, 2, 3}, {5, -2, 7.5, 3}}, {"two", {1, 3}, {1, 2}}},
                             {},          true};
  const std::string svg = charts_svg(std::vector{content}, {1280, 800}, false);
  expect_well_formed(svg);
  EXPECT_THAT(svg, HasSubstr("width=\"1280\" height=\"800\""));
  EXPECT_THAT(svg, HasSubstr(">gain [nats]</text>"));
  const auto lines = all(svg, "<polyline[^>]*points=\"([^\"]*)\"");
  ASSERT_EQ(lines.size(), 2u);
  ASSERT_EQ(all(svg, "(<circle)").size(), 6u);
  const Scale x = scale(svg, "middle", true), y = scale(svg, "end", false);
  for (std::size_t s = 0; s < 2; ++s) {
    std::istringstream points(lines[s]);
    for (std::size_t i = 0; i < content.series[s].x.size(); ++i) {
      double px = 0, py = 0;
      char comma = 0;
      points >> px >> comma >> py;
      EXPECT_NEAR(px, x.at(content.series[s].x[i]), 0.02) << s << " " << i;
      EXPECT_NEAR(py, y.at(content.series[s].y[i]), 0.02) << s << " " << i;
    }
  }
}

TEST(ChartSvg, TheAxisEndsWithTheDataUnlessItIsTold) {
  ChartContent content{"t", "view", "", "coverage", "%", {{"one", {0, 1}, {3, 40}}}, {}, true};
  const auto highest = [&] {
    const std::vector<ChartContent> charts = {content};
    return scale(charts_svg(charts, {640, 400}, false), "end", false).value_b;
  };
  EXPECT_EQ(highest(), 40);
  content.y_high = 100;
  EXPECT_EQ(highest(), 100);
}

TEST(ChartSvg, ValuesThatAreNotFiniteLeaveGaps) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ChartContent content{"t", "view", "", "gain", "&", {{"one", {0, 1, 2, 3, 4}, {1, 2, nan, 4, 5}}}, {}, true};
  const std::string svg = charts_svg(std::vector{content}, {640, 400}, true);
  expect_well_formed(svg);
  EXPECT_EQ(all(svg, "(<polyline)").size(), 2u);
  EXPECT_EQ(all(svg, "(<circle)").size(), 4u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("width=\"100%\""), std::string::npos) << "transparent: no paper";
  content.series[0].y.pop_back();
  EXPECT_THROW(charts_svg(std::vector{content}, {640, 400}, true), std::invalid_argument);
  content.series.clear();
  EXPECT_EQ(all(charts_svg(std::vector{content, content, content}, {9, 9}, false), "(<g>)").size(), 3u);
}

TEST(ChartSvg, AChartWithoutValuesHasItsAxesAndNoLine) {
  const ChartContent content{"nothing & all", "view", "", "gain", "nats", {}, {}, true};
  const std::string svg = charts_svg(std::vector{content}, {640, 400}, false);
  expect_well_formed(svg);
  EXPECT_THAT(svg, Not(AnyOf(HasSubstr("<polyline"), HasSubstr("<circle"))));
  EXPECT_EQ(scale(svg, "middle", true).value_a, 0.0);
  EXPECT_EQ(scale(svg, "middle", true).value_b, 1.0);
  EXPECT_EQ(scale(svg, "end", false).value_b, 1.0);
}

TEST(ChartSvg, SeriesAreNamedInTheirColoursIfThereAreSeveral) {
  ChartContent content{"t", "view", "", "gain", "nats", {{"one", {0, 1}, {1, 2}}}, {}, true};
  const auto drawn = [&] {
    const std::vector<ChartContent> charts = {content};
    return charts_svg(charts, {640, 400}, false);
  };
  const auto named = all(drawn(), ">(one|two)</text>");
  EXPECT_TRUE(named.empty()) << "the title says what a single one is";
  content.series.push_back({"two", {0, 1}, {2, 3}});
  EXPECT_EQ(all(drawn(), ">(one|two)</text>"), (std::vector<std::string>{"one", "two"}));
  const std::vector<std::string> colours = {"#1f5fa8", "#d1401f"};  // the first of the theme
  EXPECT_EQ(all(drawn(), "<polyline[^>]* stroke=\"([^\"]*)\""), colours);
  EXPECT_EQ(all(drawn(), "<rect x[^>]* height=\"3\" fill=\"([^\"]*)\""), colours);
  const auto places = all(drawn(), "<text x=\"([^\"]*)\"[^>]*>(?:one|two)</text>");
  EXPECT_GT(std::stod(places.at(1)), std::stod(places.at(0)) + 30) << "beside each other";
}

TEST(ChartSvg, NamesThatDoNotFitBesideEachOtherStandInRows) {
  ChartContent content{"t", "view", "", "gain", "nats", {}, {}, true};
  const std::string umlauts = "\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc";
  for (int i = 0; i < 9; ++i) content.series.push_back({umlauts, {0, 1}, {1, 2}});
  const std::string svg = charts_svg(std::vector{content}, {640, 400}, false);
  const auto x = all(svg, "<text x=\"([^\"]*)\"[^>]*>" + umlauts + "</text>");
  const auto y = all(svg, "<text x=\"[^\"]*\" y=\"([^\"]*)\"[^>]*>" + umlauts + "</text>");
  ASSERT_EQ(x.size(), 9u);
  EXPECT_EQ(std::set(y.begin(), y.end()).size(), 3u) << "as many in a row as there is room for";
  for (const std::string& at : x) EXPECT_LT(std::stod(at) + 7.2 * 12, 640 - 16);
  const auto values = all(svg, "<circle cx=\"[^\"]*\" cy=\"([^\"]*)\"");
  for (const std::string& at : values) EXPECT_GT(std::stod(at), std::stod(y.back())) << "beneath all names";
}

TEST(ChartSvg, LargeValuesAreShownInThousands) {
  const ChartContent content{"t", "view", "", "entropy", "nats", {{"one", {0, 1}, {40'000, 20'000}}}, {}, true};
  const std::string svg = charts_svg(std::vector{content}, {640, 400}, false);
  EXPECT_THAT(svg, HasSubstr(">entropy [thousand nats]</text>"));
  EXPECT_THAT(svg, HasSubstr("one: 40000 nats")) << "a value has all its digits";
  const Scale y = scale(svg, "end", false);
  EXPECT_EQ(y.value_b, 40.0);
  EXPECT_EQ(all(svg, "<circle[^>]* cy=\"([^\"]*)\"").at(0), fmt::format("{:.2f}", y.at(40)));
}

TEST(ChartSvg, AValueSaysItsNumbers) {
  const ChartContent content{"t", "view", "", "gain", "nats", {{"a < b", {0, 2}, {1, 7.5}}}, {}, true};
  const std::string svg = charts_svg(std::vector{content}, {640, 400}, false);
  EXPECT_EQ(all(svg, "<title>([^<]*)</title>"),
            (std::vector<std::string>{"view 0, a &lt; b: 1 nats", "view 2, a &lt; b: 7.5 nats"}));
  EXPECT_THAT(svg, AllOf(HasSubstr(">view</text>"), HasSubstr(">gain [nats]</text>")));
  EXPECT_THAT(svg, HasSubstr("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>"));
}

TEST(ChartSvg, TheAxisBeginsAtZeroOrBelowTheData) {
  const auto lowest = [](double least) {
    const ChartContent content{"t", "view", "", "gain", "", {{"one", {0, 1}, {least, 40}}}, {}, true};
    return scale(charts_svg(std::vector{content}, {640, 400}, false), "end", false).value_a;
  };
  EXPECT_EQ(lowest(30), 0);
  EXPECT_EQ(lowest(-12), -20) << "the next round number";
}

/// Two beside each other, 640 x 400 pixels of the page each.
TEST(ChartSvg, EachChartIsDrawnInItsOwnPartOfThePage) {
  std::vector<ChartContent> charts;
  for (int i = 0; i < 5; ++i)
    charts.push_back({"t", "view", "", "gain", "nats", {{"one", {0, 1}, {1, 2}}, {"two", {0, 1}, {3, 4}}}, {}, true});
  const std::string svg = charts_svg(charts, {640, 600}, true);
  EXPECT_THAT(svg, HasSubstr("width=\"640\" height=\"600\" viewBox=\"0 0 1280 1200\""));
  std::vector<std::string> groups;
  for (std::size_t at = svg.find("<g>"); at != svg.npos; at = svg.find("<g>", at + 1))
    groups.push_back(svg.substr(at, svg.find("</g>", at) - at));
  ASSERT_EQ(groups.size(), 5u);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const double left = i % 2 ? 640.0 : 0.0, top = 400.0 * double(i / 2);
    for (const std::string& x : all(groups[i], " c?x[12]?=\"([^\"]*)\"")) {
      EXPECT_GT(std::stod(x), left) << i;
      EXPECT_LT(std::stod(x), left + 640) << i;
    }
    for (const std::string& y : all(groups[i], " c?y[12]?=\"([^\"]*)\"")) {
      EXPECT_GT(std::stod(y), top) << i;
      EXPECT_LT(std::stod(y), top + 400) << i;
    }
    EXPECT_EQ(all(groups[i], "(<circle)").size(), 4u);
  }
  const std::string one = charts_svg(std::span(charts).first(1), {640, 400}, true);
  EXPECT_THAT(one, HasSubstr("viewBox=\"0 0 640 400\"")) << "a single one has the page for itself";
}

}  // namespace
}  // namespace nextview

// The charts of this project's own study: what README says of plans and maps, as pictures.
#include "ui/report/study_charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <set>

#include "core/planner/policy.hpp"
#include "core/study/summary_table.hpp"
#include "tests/render/render_test.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const SummaryTable& own_study() {
  static const SummaryTable table(std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets" / "studies" / "nextview");
  return table;
}

TEST(Figures, ChartsOfAStudy) {
  OffscreenTarget target(64, 48);
  for (const StudyFigure& figure : study_figures()) {
    const auto drawing = figure.draw(own_study(), Look::light());
    ASSERT_TRUE(drawing) << figure.name;
    expect_screenshot("study_" + figure.name, drawing->image(target));
  }
}

TEST(Figures, ChartsOfAStudyOnDarkPaper) {
  OffscreenTarget target(64, 48);
  for (const StudyFigure& figure : study_figures())
    if (figure.name == "coverage_by_view" || figure.name == "gap_closed" || figure.name == "stationarity" ||
        figure.name == "log_loss_by_sensor")
      expect_screenshot("study_" + figure.name + "_dark", figure.draw(own_study(), Look::dark())->image(target));
}

/// A text of an SVG that reaches beyond its sides, by about how wide it is; empty if none does.
std::string beyond_sides(const std::string& svg, double width) {
  const std::regex text("<text x=\"([0-9.-]+)\"[^>]*font-size=\"([0-9]+)\"[^>]*text-anchor=\"([a-z]+)\"[^>]*>([^<]*)<");
  for (std::sregex_iterator found(svg.begin(), svg.end(), text), end; found != end; ++found) {
    const double x = std::stod((*found)[1]), wide = text_width((*found)[4], std::stoi((*found)[2]));
    const double left = x - ((*found)[3] == "end" ? wide : (*found)[3] == "middle" ? 0.5 * wide : 0.0);
    if (left < 0.0 || left + wide > width) return (*found)[4];
  }
  return "";
}

TEST(StudyCharts, AreLaidOutForTheColumnOfAPaper) {
  constexpr double column = 447;  // 85 mm with letters of 7 pt [px]
  for (const StudyFigure& figure : study_figures()) {
    const auto drawing = figure.draw(own_study(), Sheet(Look::light(), column));
    ASSERT_TRUE(drawing) << figure.name;
    EXPECT_EQ(beyond_sides(drawing->svg(), drawing->width()), "") << figure.name;
    EXPECT_EQ(drawing->smallest_text(), theme::small_text) << figure.name;
    const bool is_matrix = figure.name.ends_with("_by_object") || figure.name.ends_with("_by_sensor");
    EXPECT_TRUE(is_matrix || drawing->width() == column) << figure.name;
  }
  const auto figures = study_figures();
  const auto curves = std::ranges::find(figures, "coverage_by_view", &StudyFigure::name);
  EXPECT_THAT(curves->draw(own_study(), Sheet(Look::light(), column))->svg(85.0), HasSubstr("width=\"85mm\""));
}

/// Divergences of as many objects after six and after nine views, made up.
std::string title_of_maps(int objects_of_nine) {
  const TemporaryFolder folder;
  std::string rows = "part,block,object,sensor,views,method,measure,at,runs,mean,spread,better,of_runs,hash,note\n";
  for (const int views : {6, 9})
    for (const char* object : {"box", "sphere", "plate"}) {
      if (views == 9 && objects_of_nine-- <= 0) continue;
      for (const char* method : {"conventional", "gibbs"})
        rows += fmt::format("maps,1,{},paper,{},{},d_kl[nats],0,2,40.25,1.5,,7-8,00aa,\n", object, views, method);
    }
  folder.write("summary.csv", rows);
  const SummaryTable table(folder / "");
  const auto figures = study_figures();
  const auto figure = std::ranges::find(figures, "divergence_by_object", &StudyFigure::name);
  const auto drawing = figure->draw(table, Look::light());
  return drawing ? drawing->svg() : "";
}

TEST(StudyCharts, AreOfTheMostViewsUnderWhichAllWasTried) {
  EXPECT_THAT(title_of_maps(3), HasSubstr("9 views"));
  for (const int objects : {0, 1, 2}) EXPECT_THAT(title_of_maps(objects), HasSubstr("6 views")) << objects;
}

/// A chart of a summary that is made up: rows "object,sensor,views,method,measure,at,runs,mean,spread".
std::string chart(const std::string& name, const std::vector<std::string>& rows, const std::string& part = "planning") {
  const TemporaryFolder folder;
  std::string text = "part,block,object,sensor,views,method,measure,at,runs,mean,spread,better,of_runs,hash,note\n";
  for (const std::string& row : rows) text += part + ",1," + row + ",,1-2,00aa,\n";
  folder.write("summary.csv", text);
  const auto figures = study_figures();
  const auto drawing =
      std::ranges::find(figures, name, &StudyFigure::name)->draw(SummaryTable(folder / ""), Look::light());
  return drawing ? drawing->svg() : "";
}

/// The colours of the names at the curves' ends.
std::vector<std::string> colours_of(const std::string& svg, const std::vector<std::string>& methods) {
  std::vector<std::string> colours;
  for (const std::string& method : methods) {
    const std::size_t name = svg.find(">" + method + "<");
    const std::size_t fill = svg.rfind("fill=\"", name);
    colours.push_back(name == std::string::npos ? "" : svg.substr(fill + 6, 7));
  }
  return colours;
}

std::vector<std::string> courses_of(const std::vector<std::string>& methods) {
  std::vector<std::string> rows;
  for (const std::string& method : methods)
    for (const int view : {1, 2})
      rows.push_back(fmt::format("(mean),paper,2,{},coverage[%],{},2,{},1.5", method, view, 40 * view));
  return rows;
}

TEST(StudyCharts, HaveCaptionsThatNeedNoOther) {
  for (const StudyFigure& figure : study_figures())
    EXPECT_THAT(figure.caption, Not(HasSubstr("he same"))) << figure.name;
}

TEST(StudyCharts, SayInWordsWhatTheyAreOf) {
  const std::string svg = chart("divergence_by_object", {"box,noise_5mm,1,gibbs,d_kl[nats],0,2,40,1.5"}, "maps");
  EXPECT_THAT(svg, HasSubstr("1 view, noise 5mm"));
}

TEST(StudyCharts, TellPlansOfAStudysOwnApart) {
  const std::vector<std::string> few = {"careful", "eager", "random"};
  const auto colours = colours_of(chart("coverage_by_view", courses_of(few)), few);
  EXPECT_EQ(std::set(colours.begin(), colours.end()).size(), 3u) << fmt::format("{}", fmt::join(colours, " "));
  EXPECT_THAT(colours, Not(Contains("#5b6675"))) << "grey";
}

TEST(StudyCharts, OfManyPlansShowTheStudysOwnInColours) {
  std::vector<std::string> many = policy_names();
  many.insert(many.end(), {"careful", "eager"});
  const std::string svg = chart("coverage_by_view", courses_of(many));
  EXPECT_THAT(colours_of(svg, {"careful", "eager"}), Not(Contains("#5b6675")));
  EXPECT_THAT(colours_of(svg, {"farthest"}), ElementsAre("#5b6675"));
}

TEST(StudyCharts, OfPredictionsAreOfEveryPlanThatPredictsNewSurface) {
  std::vector<std::string> rows;
  for (const char* method : {"careful", "eager"})
    for (const char* measure : {"predicted_gain[cm²]", "new_surface[cm²]"})
      rows.push_back(fmt::format("box,paper,2,{},{},2,2,40,1.5", method, measure));
  const std::string both = chart("predicted_and_seen", rows);
  EXPECT_THAT(colours_of(both, {"careful", "eager"}), ElementsAre("#1f5fa8", "#d1401f"));
  EXPECT_THAT(both, HasSubstr("predicted, and seen"));
  rows.resize(2);
  EXPECT_THAT(chart("predicted_and_seen", rows), HasSubstr("predicted by careful, and seen"));
}

TEST(Drawings, FitInTheMiddleOfAPage) {
  VectorDrawing drawing(100, 50, Look::light());
  drawing.box(0, 0, 100, 50, theme::chosen);
  OffscreenTarget target(64, 48);
  // Twice as large, with 50 px of paper above and below.
  const Image image = drawing.image(target, PictureSize{200, 200});
  const auto red = [&](int x, int y) { return int(image.rgba.at((std::size_t(y) * 200 + x) * 4)); };
  const auto green = [&](int x, int y) { return int(image.rgba.at((std::size_t(y) * 200 + x) * 4 + 1)); };
  EXPECT_EQ(image.width, 200);
  EXPECT_EQ(image.height, 200);
  for (const int x : {2, 100, 197}) {
    for (const int y : {2, 46, 153, 197}) EXPECT_EQ(green(x, y), 255) << x << " " << y;
    for (const int y : {53, 100, 146}) EXPECT_EQ(green(x, y), 0x40) << x << " " << y;
  }
  EXPECT_EQ(red(100, 100), 0xD1);
}

}  // namespace
}  // namespace nextview

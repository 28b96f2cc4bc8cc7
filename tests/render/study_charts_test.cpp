// The charts of this project's own study: what README says of plans and maps, as pictures.
#include "ui/report/study_charts.hpp"

#include "core/study/summary_table.hpp"
#include "tests/render/render_test.hpp"

namespace nextview {
namespace {

const SummaryTable& own_study() {
  static const SummaryTable table(std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets" / "studies" / "nextview");
  return table;
}

TEST(Figures, ChartsOfAStudy) {
  for (const StudyFigure& figure : study_figures()) {
    const auto drawing = figure.draw(own_study(), Look::light());
    ASSERT_TRUE(drawing) << figure.name;
    expect_screenshot("study_" + figure.name, drawing->image());
  }
}

TEST(Figures, ChartsOfAStudyOnDarkPaper) {
  for (const StudyFigure& figure : study_figures())
    if (figure.name == "coverage_by_view" || figure.name == "gap_closed" || figure.name == "stationarity" ||
        figure.name == "log_loss_by_sensor")
      expect_screenshot("study_" + figure.name + "_dark", figure.draw(own_study(), Look::dark())->image());
}

TEST(Drawings, FitInTheMiddleOfAPage) {
  VectorDrawing drawing(100, 50, Look::light());
  drawing.box(0, 0, 100, 50, theme::chosen);
  const Image image = drawing.image(PictureSize{200, 200});  // twice as large, with 50 px of paper above and below
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

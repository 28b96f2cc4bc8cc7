// The curves: which records they are of, in which unit, under which name.
#include <gmock/gmock.h>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"
#include "ui/panels/curves_panel.hpp"

namespace nextview {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names(const ChartContent& content) {
  std::vector<std::string> result;
  for (const ChartSeries& series : content.series) result.push_back(series.name);
  return result;
}

/// The value of each curve at the last view.
std::vector<double> last(const ChartContent& content) {
  std::vector<double> result;
  for (const ChartSeries& series : content.series) {
    EXPECT_EQ(series.x.size(), series.y.size()) << series.name;
    EXPECT_EQ(series.x.back(), 2) << series.name;
    result.push_back(series.y.back());
  }
  return result;
}

TEST(Curves, EachShowsItsColumnInItsUnit) {
  const auto s = made_scan();
  const ChartContent entropy = curve_content(*s, CurveKind::entropy), coverage = curve_content(*s, CurveKind::coverage),
                     divergence = curve_content(*s, CurveKind::divergence), gain = curve_content(*s, CurveKind::gain),
                     time = curve_content(*s, CurveKind::time);
  EXPECT_THAT(names(entropy), ElementsAre("unmeasured entropy", "total entropy"));
  EXPECT_THAT(last(entropy), ElementsAre(4.5, 3.25));
  EXPECT_EQ(entropy.y_unit, "Mbit");
  EXPECT_THAT(entropy.title, HasSubstr("[Mbit]"));
  EXPECT_THAT(names(coverage), ElementsAre("of visible surface", "of all surface"));
  EXPECT_THAT(last(coverage), ElementsAre(62.5, 37.5));
  EXPECT_EQ(coverage.y_high, 100.0);
  EXPECT_EQ(coverage.y_unit, "%");
  EXPECT_THAT(names(divergence), ElementsAre("conventional map"));
  EXPECT_THAT(last(divergence), ElementsAre(7.5));
  EXPECT_EQ(divergence.y_unit, "knats");
  EXPECT_THAT(names(gain), ElementsAre("realised (Eq. 12)", "predicted"));
  EXPECT_THAT(last(gain), ElementsAre(321, 12.5));
  EXPECT_EQ(gain.title, "Gain predicted and realised [nats]");
  EXPECT_THAT(names(time), ElementsAre("score", "insert", "sense, clean", "evaluate", "refine"));
  EXPECT_THAT(last(time), ElementsAre(8, 1, 0.75, 4, 2));
  EXPECT_EQ(time.y_unit, "s");
}

TEST(Curves, NewSurfaceIsExpectedAndSeenInOneUnit) {
  const auto s = made_scan();
  s->gain_unit = "cm²";
  for (StepRecord& r : s->records) r.gain_unit = s->gain_unit;
  const ChartContent gain = curve_content(*s, CurveKind::gain);
  EXPECT_THAT(names(gain), ElementsAre("seen", "expected"));
  EXPECT_THAT(last(gain), ElementsAre(214, 12.5));
  EXPECT_EQ(gain.y_unit, "cm²");
}

TEST(Curves, TheDistanceThatCoverageIsCountedAtIsInMillimetres) {
  const auto s = made_scan();
  auto setup = std::make_shared<ScanSetup>(*s->setup);
  setup->configuration.evaluation.d_reg = 0.0075;
  s->setup = setup;
  EXPECT_EQ(curve_content(*s, CurveKind::coverage).title, "Surface within 7.5 mm of a point [%]");
}

TEST(Curves, EntropyAndCoverageBeginBeforeTheFirstView) {
  const auto s = made_scan();
  for (const CurveKind kind : {CurveKind::entropy, CurveKind::coverage}) {
    const auto all = curve_content(*s, kind).series;
    ASSERT_FALSE(all.empty()) << int(kind);
    for (const ChartSeries& series : all) {
      EXPECT_THAT(series.x, ElementsAre(0, 1, 2));
      EXPECT_NEAR(series.y[0], kind == CurveKind::entropy ? double(s->grid.voxel_count()) / 1e6 : 0, 1e-12)
          << "a voxel that nobody measured has a bit";
    }
  }
  for (const CurveKind kind : {CurveKind::divergence, CurveKind::gain, CurveKind::time}) {
    const auto all = curve_content(*s, kind).series;
    ASSERT_FALSE(all.empty()) << int(kind);
    for (const ChartSeries& series : all) {
      const bool is_of_choice = series.name == "expected" || series.name == "predicted";
      EXPECT_EQ(series.x, is_of_choice ? std::vector<double>{2} : (std::vector<double>{1, 2})) << series.name;
    }
  }
}

TEST(Curves, EarlierRunsStayBehindWithTheirFirstCurve) {
  auto s = made_scan();
  std::vector<nextview::Run> runs(3);
  for (std::size_t run = 0; run < 3; ++run) {
    runs[run].name = run == 0 ? "random" : run == 1 ? "farthest" : "of another object";
    runs[run].object = run < 2 ? s->object_name : "box";
    for (int step = 1; step <= 3; ++step) {
      StepRecord r;
      r.step = step;
      r.entropy = 1e6 * double(10 * (run + 1) + step);
      r.total_entropy = 1;
      r.coverage_visible = 0.1 * step;
      runs[run].records.push_back(r);
    }
  }
  s->earlier_runs = std::make_shared<const std::vector<nextview::Run>>(runs);
  const ChartContent content = curve_content(*s, CurveKind::entropy);
  ASSERT_THAT(names(content), ElementsAre("unmeasured entropy", "total entropy", "random", "farthest"));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(content.series[i].earlier, i >= 2) << content.series[i].name;
  EXPECT_THAT(content.series[2].x, ElementsAre(1, 2, 3));
  EXPECT_THAT(content.series[2].y, ElementsAre(11, 12, 13));
  EXPECT_THAT(content.series[3].y, ElementsAre(21, 22, 23));
  EXPECT_THAT(curve_content(*s, CurveKind::coverage).series[2].y,
              ElementsAre(DoubleNear(10, 1e-9), DoubleNear(20, 1e-9), DoubleNear(30, 1e-9)));
}

TEST(Curves, WithoutEvaluationNothingIsSaidOfTheTruth) {
  auto s = made_scan();
  s->configuration.evaluation.enabled = false;
  for (const CurveKind kind : {CurveKind::coverage, CurveKind::divergence}) {
    EXPECT_TRUE(curve_content(*s, kind).series.empty());
    EXPECT_THAT(curve_content(*s, kind).title, HasSubstr("evaluation is off"));
  }
  EXPECT_EQ(curve_content(*s, CurveKind::entropy).series.size(), 2u);
}

/// The plots that are drawn: each the kind that was chosen for it, with the values at the pointer.
TEST(Curves, ThePlotsShowWhatWasChosenAndTheValuesAtThePointer) {
  Desk desk;
  desk.snapshot = made_scan();
  desk.window.curves = {CurveKind::gain, CurveKind::coverage};
  desk.frames();
  const auto texts = seen_texts();
  const SeenText* left = find_text(texts, "Gain predicted", "Curves");
  const SeenText* right = find_text(texts, "Surface within", "Curves");
  ASSERT_TRUE(left && right) << read("Curves");
  EXPECT_LT(left->from.x, right->from.x);
  EXPECT_THAT(read("Curves"), HasSubstr("realised (Eq. 12)"));
  EXPECT_THAT(read("Curves"), HasSubstr("of all surface"));
  const Rectangle& r = desk.layout().bottom;
  desk.move(r.x + r.width - 70, r.y + r.height - 60);  // near the last view of the right plot
  desk.frames();
  EXPECT_EQ(read_tooltip(), "view 2 of visible surface: 62.5 % of all surface: 37.5 %");
}

/// Beside the longest names that two curves have, in a window of the usual width.
TEST(Curves, OthersAreNamedInWhole) {
  Desk desk;
  auto scan = std::make_shared<SessionSnapshot>(*made_scan());
  scan->earlier_runs =
      std::make_shared<const std::vector<nextview::Run>>(1, nextview::Run{"sphere, random", scan->records, "sphere"});
  desk.snapshot = scan;
  desk.window.curves = {CurveKind::entropy, CurveKind::coverage};
  desk.frames();
  EXPECT_THAT(read("Curves"), HasSubstr("unmeasured entropy total entropy others"));
}

TEST(Curves, AChoiceOfOnePlotLeavesTheOther) {
  Desk desk;
  desk.snapshot = made_scan();
  desk.window.curves = {CurveKind::gain, CurveKind::coverage};
  desk.frames();
  const Rectangle& r = desk.layout().bottom;
  desk.click(r.x + r.width - 24, r.y + 8 + 32 + 8);  // the arrow at the right plot's title
  desk.frames();
  EXPECT_EQ(text_of(click_on(desk, "divergence")), "curves gain divergence");
  EXPECT_EQ(desk.window.curves, (std::array{CurveKind::gain, CurveKind::divergence}));
}

}  // namespace
}  // namespace nextview

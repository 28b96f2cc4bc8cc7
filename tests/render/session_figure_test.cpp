// What a session's picture and curves say of its records, in their units.
#include "ui/figures/session_figure.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/export/scan_files.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;

std::vector<std::string> names_of(const ChartContent& chart) {
  std::vector<std::string> names;
  for (const ChartSeries& series : chart.series) names.push_back(series.name);
  return names;
}

/// Of each record a point, at its step, with this value in the curve's unit.
void expect_curve(const ChartSeries& series, const Session& session,
                  const std::function<double(const StepRecord&)>& value) {
  ASSERT_EQ(series.x.size(), session.records().size());
  ASSERT_EQ(series.y.size(), session.records().size());
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    EXPECT_EQ(series.x[k], session.records()[k].step);
    EXPECT_NEAR(series.y[k], value(session.records()[k]), 1e-9 * std::abs(value(session.records()[k]))) << series.name;
  }
}

TEST(StepPictures, CurvesAreOfAllRecordsInPercentAndMegabits) {
  Session session(small_scan());
  session.step(), session.step(), session.step();
  const StepPicture picture = step_picture(session);
  EXPECT_THAT(names_of(picture.coverage), ElementsAre("of the visible surface", "of all the surface"));
  expect_curve(picture.coverage.series[0], session, [](const StepRecord& r) { return r.coverage_visible / 0.01; });
  expect_curve(picture.coverage.series[1], session, [](const StepRecord& r) { return r.coverage / 0.01; });
  EXPECT_GT(picture.coverage.series[0].y.back(), 5.0);
  EXPECT_EQ(picture.entropy.y_unit, "Mbit");
  expect_curve(picture.entropy.series[0], session, [](const StepRecord& r) { return r.entropy * 1e-6; });
  expect_curve(picture.entropy.series[1], session, [](const StepRecord& r) { return r.total_entropy * 1e-6; });
  EXPECT_EQ(picture.step, session.records().back().step);
  EXPECT_EQ(picture.step_count, 4);
  EXPECT_EQ(picture.object_name, "box");
  EXPECT_EQ(picture.path.size(), 3u);
  EXPECT_EQ(picture.taken.size(), 2u) << "the start view is no candidate";
  EXPECT_EQ(picture.chosen, session.next_candidate());
  EXPECT_EQ(picture.scores.size(), session.candidates().size());
}

TEST(StepPictures, OfARecordingTheCoverageIsOfWhatAllFramesShow) {
  const TemporaryFolder folder;
  const std::filesystem::path scan = folder / "scan";
  {
    Session session(small_scan());
    finish(session);
    OutputFolder out(scan, {});
    out.begin("scan");
    write_scan(session, out);
  }
  Configuration c;
  c.recorded.folder = scan.string();
  c.planner.gain = "fixed-order";
  Session session(c);
  session.step(), session.step();
  const auto first = [&] { return step_picture(session).coverage.series.front(); };
  EXPECT_EQ(first().name, "of what all frames show");
  EXPECT_TRUE(first().y.back() > first().y.front() && first().y.back() < 100.0) << first().y.back();
  expect_curve(first(), session, [](const StepRecord& r) { return r.coverage_recorded.value() / 0.01; });
  finish(session);
  EXPECT_NEAR(first().y.back(), 100.0, 1e-9) << "all frames were taken";
}

}  // namespace
}  // namespace nextview

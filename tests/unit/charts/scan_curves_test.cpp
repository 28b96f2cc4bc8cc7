// How a scan went, as curves: which record's number stands where, and in what unit.
#include "ui/charts/scan_curves.hpp"

#include <gmock/gmock.h>

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Two views; every number is another, so that none is taken for its neighbour.
class ScanCurves : public testing::Test {
 protected:
  ScanCurves() {
    records_.resize(2);
    for (int i = 0; i < 2; ++i) {
      StepRecord& r = records_[i];
      r.step = i + 1, r.view = 5 + i;
      r.entropy = (i + 1) * 1e6, r.total_entropy = (i + 1) * 3e6;
      r.coverage = 0.25 * (i + 1), r.coverage_visible = 0.375 * (i + 1);
      r.quality.divergence = (i + 1) * 7e3;
      r.gain = 11.0 + i, r.new_surface = 13.0 + i, r.realised_gain = 17.0 + i;
      r.seconds = {.sense = 1.0, .clean = 2.0, .insert = 4.0, .refine = 8.0, .evaluate = 16.0, .score = 32.0 + i};
    }
    course_.records = records_;
    course_.start = {4e6, 5e6};
  }
  static std::vector<std::string> names(const ChartContent& chart) {
    std::vector<std::string> names;
    for (const ChartSeries& series : chart.series) names.push_back(series.name);
    return names;
  }
  /// All views are chosen by a planner of this unit.
  void plan_in(const std::string& unit) {
    course_.gain_unit = unit;
    for (StepRecord& r : records_) r.gain_unit = unit;
  }
  std::vector<std::string> titles() const {
    std::vector<std::string> titles;
    for (const ChartContent& chart : scan_charts(course_)) titles.push_back(chart.title);
    return titles;
  }

  std::vector<StepRecord> records_;
  ScanCourse course_;
};

TEST_F(ScanCurves, EntropyBeginsWithThatOfTheMapBeforeTheFirstView) {
  const ChartContent chart = entropy_chart(course_);
  EXPECT_THAT(names(chart), ElementsAre("unmeasured entropy", "total entropy"));
  EXPECT_THAT(chart.series.at(0).x, ElementsAre(0, 1, 2));
  EXPECT_THAT(chart.series.at(0).y, ElementsAre(4, 1, 2)) << "in millions";
  EXPECT_THAT(chart.series.at(1).y, ElementsAre(5, 3, 6));
  EXPECT_EQ(chart.y_unit, "Mbit");
  EXPECT_FALSE(chart.y_high);
}

TEST_F(ScanCurves, CoverageIsInPercentOfOneScale) {
  const ChartContent chart = coverage_chart(course_);
  EXPECT_EQ(chart.title, "Surface within 5 mm of a point [%]");
  EXPECT_THAT(names(chart), ElementsAre("of visible surface", "of all surface"));
  EXPECT_THAT(chart.series.at(0).x, ElementsAre(0, 1, 2));
  EXPECT_THAT(chart.series.at(0).y, ElementsAre(0, 37.5, 75));
  EXPECT_THAT(chart.series.at(1).y, ElementsAre(0, 25, 50));
  EXPECT_EQ(chart.y_high, 100.0);
  EXPECT_TRUE(chart.whole_x);
}

TEST_F(ScanCurves, ARecordingsViewsAreComparedWithOtherOrders) {
  EXPECT_THAT(names(recorded_coverage_chart(course_)), IsEmpty());
  const CoverageByOrder orders{{0.5, 1.0}, {0.25, 0.75, 1.0}, {0.375}};
  course_.orders = &orders;
  course_.d_reg = 0.0025;
  const ChartContent chart = recorded_coverage_chart(course_);
  EXPECT_EQ(chart.title, "Of all frames, within 2.5 mm [%]");
  EXPECT_THAT(names(chart), ElementsAre("planned", "as recorded", "random"));
  EXPECT_THAT(chart.series.at(0).x, ElementsAre(1, 2));
  EXPECT_THAT(chart.series.at(0).y, ElementsAre(50, 100));
  EXPECT_THAT(chart.series.at(1).x, ElementsAre(1, 2, 3));
  EXPECT_THAT(chart.series.at(1).y, ElementsAre(25, 75, 100));
  EXPECT_THAT(chart.series.at(2).y, ElementsAre(37.5));
  EXPECT_EQ(chart.y_high, 100.0);
}

TEST_F(ScanCurves, TheEntropyOfTwoMapsIsTwoCurves) {
  records_[1].refinement.emplace();
  const ChartContent chart = entropy_chart(course_);
  EXPECT_THAT(names(chart), ElementsAre("unmeasured entropy", "total entropy", "total entropy, Gibbs map"));
  EXPECT_THAT(chart.series.at(1).x, ElementsAre(0, 1));
  EXPECT_THAT(chart.series.at(2).x, ElementsAre(2)) << "nothing leads there from before the first view";
  EXPECT_THAT(chart.series.at(2).y, ElementsAre(6));
  records_[0].refinement.emplace();
  EXPECT_THAT(names(entropy_chart(course_)), ElementsAre("unmeasured entropy", "total entropy"));
}

TEST_F(ScanCurves, WhatWasExpectedInAnotherUnitIsNotDrawn) {
  plan_in("cm²");
  records_[0].gain_unit = "nats";
  const ChartContent surface = gain_chart(course_);
  EXPECT_THAT(surface.series.at(0).x, ElementsAre(1, 2));
  EXPECT_THAT(surface.series.at(1).x, ElementsAre(2));
  course_.gain_unit = "nats";
  const ChartContent nats = gain_chart(course_);
  EXPECT_THAT(nats.series.at(1).x, ElementsAre(1));
  EXPECT_THAT(nats.series.at(1).y, ElementsAre(11));
}

TEST_F(ScanCurves, NewSurfaceIsComparedWithWhatWasExpected) {
  plan_in("cm²");
  const ChartContent chart = gain_chart(course_);
  EXPECT_THAT(names(chart), ElementsAre("seen", "expected"));
  EXPECT_THAT(chart.series.at(0).x, ElementsAre(1, 2)) << "before the first view there is none";
  EXPECT_THAT(chart.series.at(0).y, ElementsAre(13, 14));
  EXPECT_THAT(chart.series.at(1).y, ElementsAre(11, 12));
  EXPECT_EQ(chart.y_unit, "cm²");
}

TEST_F(ScanCurves, NobodyExpectedAnythingOfTheStartView) {
  plan_in("cm²");
  auto records = std::vector<StepRecord>(course_.records.begin(), course_.records.end());
  records.front().view = -1;
  course_.records = records;
  const ChartContent chart = gain_chart(course_);
  EXPECT_THAT(chart.series.at(0).x, ElementsAre(1, 2));
  EXPECT_THAT(chart.series.at(1).x, ElementsAre(2));
}

TEST_F(ScanCurves, AGainInNatsStandsBesideTheEntropyThatWasLost) {
  plan_in("nats");
  const ChartContent chart = gain_chart(course_);
  EXPECT_EQ(chart.title, "Gain predicted and realised [nats]");
  EXPECT_THAT(names(chart), ElementsAre("realised (Eq. 12)", "predicted"));
  EXPECT_THAT(chart.series.at(0).y, ElementsAre(17, 18));
  EXPECT_THAT(chart.series.at(1).y, ElementsAre(11, 12));
  EXPECT_EQ(chart.y_unit, "nats");
}

TEST_F(ScanCurves, OfAGainOfAnotherUnitNothingStandsBesideTheSurfaceThatWasSeen) {
  for (const char* unit : {"voxels", "nats/voxel", ""}) {
    plan_in(unit);
    const ChartContent chart = gain_chart(course_);
    EXPECT_EQ(chart.title, "New surface of a view [cm²]") << unit;
    EXPECT_THAT(names(chart), ElementsAre("seen")) << unit;
    EXPECT_THAT(chart.series.at(0).y, ElementsAre(13, 14)) << unit;
  }
}

TEST_F(ScanCurves, DivergenceIsInThousands) {
  const ChartContent chart = divergence_chart(course_);
  EXPECT_THAT(chart.series.at(0).y, ElementsAre(7, 14));
  EXPECT_EQ(chart.y_unit, "knats");
}

TEST_F(ScanCurves, EachStageHasItsSeconds) {
  const ChartContent chart = time_chart(course_);
  EXPECT_THAT(names(chart), ElementsAre("score", "insert", "sense, clean", "evaluate", "refine"));
  std::vector<double> first;
  for (const ChartSeries& series : chart.series) first.push_back(series.y.at(0));
  EXPECT_THAT(first, ElementsAre(32, 4, 1 + 2, 16, 8));
  EXPECT_THAT(chart.series.at(0).y, ElementsAre(32, 33));
}

TEST_F(ScanCurves, OnlyWhatIsKnownIsDrawn) {
  EXPECT_THAT(titles(), ElementsAre("Entropy of the map [Mbit]", "Surface within 5 mm of a point [%]",
                                    "New surface of a view [cm²]", "D_KL to the truth, visited voxels [knats]"));
  course_.is_evaluated = false;
  EXPECT_THAT(titles(), ElementsAre("Entropy of the map [Mbit]", "New surface of a view [cm²]"));
  const CoverageByOrder orders{{0.5}, {0.5}, {0.5}};
  course_.orders = &orders;
  EXPECT_THAT(titles(), ElementsAre("Entropy of the map [Mbit]", "Of all frames, within 5 mm [%]",
                                    "New surface of a view [cm²]"));
  course_.is_evaluated = true;
  EXPECT_EQ(titles().size(), 4u) << "frames' own surface in place of the truth's";
}

}  // namespace
}  // namespace nextview

// Where the timeline draws the views of branches, and what leads from one to another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/panels/seen.hpp"

namespace nextview {
namespace {

/// 'main' with three views, and others that leave it at these, each with views up to its third.
std::shared_ptr<const SessionSnapshot> with_branches(const std::vector<std::size_t>& left_at) {
  const SessionRunner::JobControl control{[](double, std::string_view) {}, [](const SamplerDiagnostics&) {}, {}};
  SessionRunner runner;
  runner.load(small_scan(), control);
  for (int i = 0; i < 3; ++i) runner.step(control);
  for (const std::size_t views : left_at) {
    runner.go_to("main", views, control);
    for (std::size_t i = views; i < 3; ++i) runner.step(control);
  }
  return runner.snapshot();
}

class TimelinePanelTest : public testing::Test {
 protected:
  void show(const std::shared_ptr<const SessionSnapshot>& snapshot) {
    desk_.snapshot = snapshot;
    desk_.window.bring_to_front("timeline");
    desk_.frames();
  }
  Desk desk_{1280, 800};
};

TEST_F(TimelinePanelTest, WhatLeadsToABranchGoesBetweenThePicturesOfOthers) {
  show(with_branches({1, 2}));
  const auto lines = seen_areas(theme::muted, "Timeline"), pictures = seen_areas(theme::sky, "Timeline");
  EXPECT_GE(lines.size(), 2u);
  EXPECT_GE(pictures.size(), 3u);
  for (const ImRect& line : lines)
    for (const ImRect& picture : pictures)
      EXPECT_FALSE(picture.Overlaps(line)) << "at " << line.Min.x << ", " << picture.Min.y;
}

TEST_F(TimelinePanelTest, TheBranchThatTheScanIsOnIsScrolledIntoView) {
  const std::vector<std::size_t> left_at(7, 2);
  show(with_branches(left_at));
  const auto shows = [](const char* branch) { return find_text(seen_texts(), branch, "Timeline") != nullptr; };
  EXPECT_TRUE(shows("branch 8")) << read("Timeline");
  EXPECT_FALSE(shows("main")) << "all have room: this tests nothing";
}

/// From view 10 on a tenth of a percent more would be as wide as its picture and the gap beside it.
TEST_F(TimelinePanelTest, WhatAViewCameToStandsApartFromThatOfTheNext) {
  auto snapshot = std::make_shared<SessionSnapshot>(*with_branches({}));
  auto timeline = std::make_shared<Timeline>(*snapshot->timeline);
  StepRecord record = *timeline->steps.back().record;
  record.coverage_visible = 0.9966;
  timeline->steps.clear();
  for (std::uint32_t number = 1; number <= 42; ++number)
    timeline->steps.push_back({number, number - 1, std::make_shared<StepRecord>(record), nullptr});
  timeline->branches.all.front().tip = timeline->at = 42;
  snapshot->timeline = timeline;
  show(snapshot);
  EXPECT_THAT(read("Timeline"), testing::HasSubstr("42 views, 99.6 %"));
  EXPECT_THAT(read("Timeline"), testing::MatchesRegex(".* 40 · 99 % *41 · 99 % *42 · 99 %"));
}

}  // namespace
}  // namespace nextview

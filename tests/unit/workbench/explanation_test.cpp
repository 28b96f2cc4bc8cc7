// Why a view is worth what the ranking says.
#include <gmock/gmock.h>

#include "tests/unit/workbench/inspected_scan.hpp"

namespace nextview {
namespace {

using Kind = ViewSelection::Kind;

TEST(Explanation, ExplanationsAddUpToTheRanking) {
  for (const Gain& gain : gains())
    for (const Semantics semantics : {Semantics::published, Semantics::reference}) {
      if (gain.name == "gibbs" && semantics == Semantics::reference) continue;  // the reference knows no Gibbs map
      InspectedScan scan(scan_by(std::string(gain.name), semantics));
      double largest = 0;
      for (int step = 0; step < 2; ++step) {
        scan.step();
        const auto& candidates = scan.now().records.back().candidates;
        for (std::size_t v = step; v < candidates.size(); v += 2) {
          const ViewInspection view = scan.look_at({Kind::candidate, v});
          const std::string what = std::string(gain.name) + ", candidate " + std::to_string(v) + ", step " +
                                   std::to_string(step) + (semantics == Semantics::reference ? ", reference" : "");
          ASSERT_NE(view.explanation, nullptr) << what;
          EXPECT_EQ(view.explanation->rays.size(), semantics == Semantics::published ? 48u : 20u);
          expect_sum(*view.explanation, what);
          largest = std::max(largest, std::abs(view.explanation->value));
          if (!candidates[v].available) continue;
          {
            EXPECT_TRUE(equal(view.explanation->value, candidates[v].gain))
                << what << ": " << view.explanation->value << " is not " << candidates[v].gain;
          }
        }
        const ViewInspection next = scan.look_at({});
        ASSERT_NE(next.explanation, nullptr);
        ASSERT_NE(scan.now().explanation, nullptr);
        EXPECT_TRUE(equal(next.explanation->value, scan.now().explanation->value));
      }
      EXPECT_GT(largest, 0) << gain.name << " is nothing all the time";
    }
}

TEST(Explanation, TheReferenceMapFollowsUndo) {
  InspectedScan scan(scan_by("rear-side-entropy", Semantics::reference));
  for (int i = 0; i < 3; ++i) scan.step();
  scan.look_at({});
  scan.runner.undo(job_control());
  scan.runner.take_view(scan.now().proposal() == 1u ? 2 : 1);
  scan.step();
  const auto& candidates = scan.now().records.back().candidates;
  double largest = 0;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    if (candidates[v].available) {
      EXPECT_TRUE(equal(scan.look_at({Kind::candidate, v}).explanation->value, candidates[v].gain)) << v;
      largest = std::max(largest, candidates[v].gain);
    }
  EXPECT_GT(largest, 0) << "of nothing any map is as good";
}

TEST(Explanation, WhatHasNoRaysSaysSo) {
  for (const PolicyEntry& policy : policies()) {
    const std::string& gain = policy.name;
    InspectedScan scan(scan_by(gain));
    EXPECT_EQ(scan.look_at({}).explanation, nullptr);
    EXPECT_THAT(scan.look_at({}).no_explanation, testing::HasSubstr("start view"));
    scan.step();
    const ViewInspection view = scan.look_at({});
    EXPECT_EQ(view.explanation == nullptr, policy.baseline || gain == "combined") << gain;
    EXPECT_EQ(view.explanation == nullptr, !view.no_explanation.empty()) << gain;
    EXPECT_EQ(view.explanation == nullptr, scan.now().explanation == nullptr) << gain;
  }
}

TEST(Explanation, AnCustomViewIsExplainedBeforeItIsTaken) {
  InspectedScan scan(scan_by("occlusion-aware"));
  scan.step();
  Selection selection;
  selection.view = {Kind::custom, 0};
  EXPECT_FALSE(scan.look(selection).view) << "there is no custom view yet";
  selection.custom_view = custom_view();
  const ViewInspection view = scan.look(selection).view.value();
  EXPECT_TRUE(view.T_world_camera.isApprox(custom_view()));
  ASSERT_NE(view.explanation, nullptr);
  expect_sum(*view.explanation, "custom view");
  EXPECT_GT(view.explanation->value, 0);
  scan.runner.take_custom_view(custom_view());
  scan.step();
  EXPECT_TRUE(equal(scan.now().records.back().gain, view.explanation->value));
}

}  // namespace
}  // namespace nextview

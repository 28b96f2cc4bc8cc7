#include <gtest/gtest.h>

#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

Configuration adaptive() {
  Configuration c = small_scan();
  c.views.layout = ViewLayout::adaptive;
  c.views.adaptive = 6;
  c.planner.weights.cost = 0.0;
  return c;
}

TEST(AdaptiveViews, AreMadeAtEachStepAndTaken) {
  Session session(adaptive()), again(adaptive());
  const std::vector<Pose> fixed = candidate_views(adaptive().views, Vector3::Zero());
  ASSERT_EQ(fixed.size(), 10u);
  std::vector<Pose> before;
  int taken = 0;
  while (session.finished().empty()) {
    const Pose wanted = session.next_view();
    taken += session.records().size() > 0 &&
             std::ranges::none_of(fixed, [&](const Pose& pose) { return pose.matrix() == wanted.matrix(); });
    session.step();
    EXPECT_EQ(session.records().back().T_world_camera.matrix(), wanted.matrix());
    const std::vector<Pose> now(session.candidates().begin(), session.candidates().end());
    ASSERT_EQ(now.size(), 16u);
    EXPECT_EQ(session.records().back().candidates.size(), now.size());
    for (std::size_t v = 0; v < fixed.size(); ++v) EXPECT_EQ(now[v].matrix(), fixed[v].matrix());
    for (std::size_t v = fixed.size(); v < before.size(); ++v) EXPECT_NE(now[v].matrix(), before[v].matrix());
    before = now;
  }
  EXPECT_EQ(session.records().size(), 4u);
  EXPECT_GT(taken, 0) << "views that fit the object beat some that do not";
  finish(again);
  EXPECT_TRUE(same_scan(session, again));
}

TEST(AdaptiveViews, AreMeasuredByWhatAnyPoseCouldSee) {
  Configuration with = small_scan(), without = small_scan();
  with.evaluation.any_pose = true;
  Session fixed(with), plain(without), made(adaptive());
  for (Session* session : {&fixed, &plain, &made}) finish(*session);
  EXPECT_EQ(fixed.setup().any_pose, made.setup().any_pose) << "whatever the views are";
  for (const Session* session : {&fixed, &made})
    EXPECT_EQ(session->records().back().coverage_any_pose,
              session->evaluation()->coverage.of(session->setup().any_pose));
  EXPECT_GT(*made.records().back().coverage_any_pose, *made.records().front().coverage_any_pose);
  EXPECT_TRUE(plain.setup().any_pose.empty());
  EXPECT_FALSE(plain.records().back().coverage_any_pose) << "nor is it computed";
  EXPECT_TRUE(same_scan(fixed, plain)) << "it decides nothing";
}

TEST(AdaptiveViews, BaselinesKnowTheFixedOnesAlone) {
  for (const char* gain : {"random", "oracle"}) {
    Configuration c = adaptive();
    c.planner.gain = gain;
    c.termination.views = 2;
    Session session(c);
    finish(session);
    EXPECT_EQ(session.candidates().size(), 10u) << gain;
  }
}

}  // namespace
}  // namespace nextview

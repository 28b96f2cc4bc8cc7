// What the scene's colours go over, and what the window keeps of a session from step to step.
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "ui/workbench/inspector.hpp"

namespace nextview {
namespace {

using testing::ElementsAreArray;

/// By gain alone: all utilities but those of taken candidates, which are 0, are over 0.
Configuration by_gain_alone() {
  Configuration c = tiny_scan();
  c.planner.ray_columns = 8;
  c.planner.ray_rows = 6;
  c.termination.views = 4;
  c.termination.surface_left = 0.0;
  c.planner.gain = "occlusion-aware";
  c.planner.weights = {1, 0};
  return c;
}

const Legend* legend(std::span<const Legend> legends, const std::string& title) {
  for (const Legend& l : legends)
    if (l.title == title && l.range) return &l;
  return nullptr;
}

ValueRange utilities_left(const SessionSnapshot& s) {
  ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Candidate& c : s.records.back().candidates)
    if (c.available) range = {std::min(range.first, c.utility), std::max(range.second, c.utility)};
  return range;
}

class SceneRanges : public testing::Test {
 protected:
  void expect_utilities(const ValueRange& range, bool locked) {
    const Legend* l = legend(user_.window().scene().layers().views().legends(), "utility");
    ASSERT_NE(l, nullptr);
    EXPECT_EQ(l->range->low, range.first);
    EXPECT_EQ(l->range->high, range.second);
    EXPECT_EQ(l->locked, locked);
  }
  User user_{by_gain_alone(), half_width, half_height, half_scale};
};

TEST_F(SceneRanges, UtilitiesAreThoseOfTheCandidatesThatAreLeft) {
  user_.run_quickly("step\nstep\nstep\n");
  const ValueRange now = utilities_left(user_.session());
  ASSERT_GT(now.first, 0) << "a taken candidate's 0 would not show";
  expect_utilities(now, false);
  user_.run_quickly("lock-ranges\n");
  expect_utilities(now, true);
  user_.run_quickly("step\n");
  EXPECT_NE(utilities_left(user_.session()), now);
  expect_utilities(now, true);
}

TEST_F(SceneRanges, FollowTheScanUnlessTheyAreLocked) {
  user_.run_quickly("step\ntoggle-cloud\ncloud-colour height\n");
  const auto heights = [&] {
    const auto& points = user_.session().cloud->points;
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
    return ValueRange(low->z(), high->z());
  };
  const auto shown = [&] {
    for (const Legend& l : user_.window().scene().layers().cloud().legends())
      if (l.range) return ValueRange(l.range->low, l.range->high);
    ADD_FAILURE() << "no legend";
    return ValueRange();
  };
  const auto most = [&] {
    for (const Legend& l : user_.window().scene().layers().rays().legends())
      if (l.range) return l.range->high;
    ADD_FAILURE() << "no legend";
    return 0.0;
  };
  const ValueRange first = heights();
  EXPECT_NEAR(shown().first, first.first, 1e-6);
  EXPECT_NEAR(shown().second, first.second, 1e-6);
  const double first_most = most();
  user_.run_quickly("step\nstep\n");
  const ValueRange third = heights();
  ASSERT_NE(third, first) << "the scan tells nothing of this";
  EXPECT_NEAR(shown().second, third.second, 1e-6);
  EXPECT_NE(most(), first_most);
  const double locked_most = most();
  user_.run_quickly("undo\nundo\nlock-ranges\nstep\nstep\n");
  EXPECT_NEAR(shown().first, first.first, 1e-6);
  EXPECT_NEAR(shown().second, first.second, 1e-6);
  EXPECT_EQ(most(), first_most);
  EXPECT_NE(most(), locked_most);
}

/// The rays of a view have the contributions of that view's own, whichever is looked at.
TEST_F(SceneRanges, RaysAreThoseOfTheViewThatIsLookedAt) {
  user_.run_quickly("step\nstep\n");
  const RaysLayer& rays = user_.window().scene().layers().rays();
  const auto box = [&] {
    Eigen::AlignedBox3d all;
    for (const Vector3& point : rays.outline()) all.extend(point);
    return all;
  };
  const Eigen::AlignedBox3d of_next = box();
  ASSERT_FALSE(of_next.isEmpty());
  const SessionSnapshot s = user_.session();
  int looked_at = 0;
  for (std::size_t k = 0; k < s.candidates.size(); ++k) {
    if (!s.available(k) || k == s.next_candidate) continue;
    user_.run_quickly("select-view " + std::to_string(k) + "\n");
    Inspector inspector;
    const Inspection inspection = inspector.inspect(user_.worker().snapshot(), user_.window().state().selection);
    ASSERT_TRUE(inspection.view && inspection.view->explanation);
    double most = 0;
    for (const auto& ray : inspection.view->explanation->rays) most = std::max(most, ray.contribution);
    ASSERT_FALSE(rays.legends().empty()) << k << ": no ray is shown";
    EXPECT_NEAR(rays.legends()[0].range->high, most, 1e-6 * most) << k;
    EXPECT_LT(box().exteriorDistance(s.candidates[k].translation()), 1e-6) << k << ": they begin at its camera";
    EXPECT_FALSE(box().isApprox(of_next)) << k;
    ++looked_at;
  }
  EXPECT_GT(looked_at, 2);
  user_.run_quickly("select-next\n");
  EXPECT_TRUE(box().isApprox(of_next));
}

TEST_F(SceneRanges, ASliceShowsFewerVoxelsAndAnotherPlaceOthers) {
  user_.run_quickly("step\nstep\n");
  const std::size_t all = user_.window().scene().voxel_faces();
  user_.run_quickly("slice-axis z\n");
  const std::size_t middle = user_.window().scene().voxel_faces();
  EXPECT_GT(middle, 0u);
  EXPECT_LT(middle, all);
  user_.run_quickly("slice-at 0.6\n");
  EXPECT_EQ(user_.window().scene().voxel_faces(), 0u) << "there is nothing above the object";
  user_.run_quickly("slice-axis none\n");
  EXPECT_EQ(user_.window().scene().voxel_faces(), all);
}

TEST_F(SceneRanges, ASelectionLastsAsLongAsWhatItIsOf) {
  using Kind = ViewSelection::Kind;
  const auto selection = [&] { return user_.window().state().selection; };
  user_.run_quickly("step\nstep\nselect-view 3\ninspect-voxel 0 0 0\nstep\n");
  EXPECT_TRUE(selection().view.is(Kind::candidate, 3)) << "a step leaves it";
  EXPECT_TRUE(selection().voxel);
  user_.run_quickly("select-taken 3\ngo-to-view 2\n");
  EXPECT_TRUE(selection().view == ViewSelection{}) << "a view that is no more";
  EXPECT_TRUE(selection().voxel);
  user_.run_quickly("select-taken 2\ngo-to-view 3\n");
  EXPECT_TRUE(selection().view.is(Kind::taken, 1));
  user_.run_quickly("set seed 5\n");
  EXPECT_EQ(selection(), Selection{}) << "of another scan";
  EXPECT_EQ(user_.window().title(), "Nextview - sphere - view 0 of 4");
}

TEST_F(SceneRanges, ACandidateThatIsNoMoreIsNotLookedAt) {
  const auto selection = [&] { return user_.window().state().selection; };
  user_.run_quickly("step\npanel view\nselect-view 7\n");
  ASSERT_EQ(selection().candidate(), 7u);
  const auto session = user_.session().session;
  user_.run_quickly("set views.count 6\n");
  ASSERT_EQ(user_.session().session, session) << "the scan goes on";
  ASSERT_LT(user_.session().candidates.size(), 8u);
  EXPECT_TRUE(selection().view == ViewSelection{});
}

/// Lines that only differ in their values, as of a slider, are one; those that add up, or name a thing, are not.
TEST_F(SceneRanges, TheScriptHasWhatWasDoneAndNothingElse) {
  user_.run_quickly(
      "step\nzoom 1\nzoom 1\nthreshold 0.2\nthreshold 0.4\nslice-axis x\nslice-at 0.1\nslice-at 0.2\nslice-at 0.2 0.1\n"
      "select-view 1\nselect-view 2\npalette\npalette\nshortcuts\nshortcuts\npause-refinement\nselect-view "
      "99\nframe\n");
  const std::vector<std::string> expected = {"step",          "zoom 1",       "zoom 1",           "threshold 0.4",
                                             "slice-axis x",  "slice-at 0.2", "slice-at 0.2 0.1", "select-view 1",
                                             "select-view 2", "frame"};
  std::vector<std::string> script = user_.window().state().history.lines;
  ASSERT_GE(script.size(), expected.size());
  script.erase(script.begin(), script.end() - long(expected.size()));
  EXPECT_THAT(script, ElementsAreArray(expected));
  std::vector<std::string> warnings;
  for (const LogEntry& entry : *user_.worker().log().entries())
    if (entry.level == LogEntry::Level::warning && !entry.text.starts_with("The ranking"))
      warnings.push_back(entry.text);
  EXPECT_THAT(warnings, testing::ElementsAre("pause-refinement: the sampler does not run",
                                             "select-view: there are 8 candidates, from 0"));
}

}  // namespace
}  // namespace nextview

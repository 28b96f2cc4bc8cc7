// Views of a recorded scene, scored by each kind of gain.
#include "core/offline/scene_scores.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// A wall 0.4 m in front of a camera, of voxels of 8 cm; two views of it and one that looks away.
RecordedScene wall() {
  RecordedScene scene;
  scene.parameters = {{"resolution_m", 0.08}};
  RecordedScan scan;
  for (int x = -5; x <= 5; ++x)
    for (int y = -5; y <= 5; ++y) scan.points.emplace_back(0.04 * x, 0.04 * y, 0.4);
  scene.scans = {scan};
  scene.views = {Pose::Identity(), look_at({0.3, 0.3, 0.0}, {0, 0, 0.4}), look_at({0, 0, 0.7}, {0, 0, 3})};
  return scene;
}

SceneScores scored(const std::vector<std::string>& names, Semantics semantics = Semantics::published) {
  return score_scene(wall(), semantics, names);
}

TEST(SceneScores, HaveAColumnOfEachGain) {
  const SceneScores scores = scored({"occlusion-aware", "gibbs", "new-surface"});
  ASSERT_EQ(scores.gains.size(), 3u);
  EXPECT_EQ(scores.gains.front(), "occlusion-aware") << "gains of single views come first";
  ASSERT_EQ(scores.views.size(), 3u);
  for (const ViewScore& view : scores.views) {
    ASSERT_EQ(view.gains.size(), 3u);
    for (const double gain : view.gains) EXPECT_TRUE(std::isfinite(gain) && gain >= 0.0) << gain;
  }
}

TEST(SceneScores, OfTheGibbsMapAreOfPublishedSemanticsAlone) {
  const SceneScores scores = scored({"gibbs"});
  EXPECT_THAT(scores.gains, testing::ElementsAre("gibbs"));
  EXPECT_GT(scores.views[1].gains.front(), 0.0) << "it sees what was not measured";
  try {
    scored({"gibbs"}, Semantics::reference);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("gibbs has published semantics only"));
  }
}

TEST(SceneScores, OfTheReferenceSemanticsAreOfItsOwnMap) {
  const SceneScores scores = scored({"occlusion-aware"}, Semantics::reference);
  ASSERT_EQ(scores.views.size(), 3u);
  for (const ViewScore& view : scores.views) EXPECT_TRUE(std::isfinite(view.gains.at(0)));
  EXPECT_NE(scores.views[1].gains, scored({"occlusion-aware"}).views[1].gains);
}

TEST(SceneScores, NeedViewsAndGainsThatThereAre) {
  RecordedScene blind = wall();
  blind.views.clear();
  const std::vector<std::string> names = {"occlusion-aware"};
  EXPECT_THROW(score_scene(blind, Semantics::published, names), std::invalid_argument);
  EXPECT_THROW(scored({"no such gain"}), std::invalid_argument);
}

TEST(SceneScores, ProgressNeverGoesBack) {
  std::vector<double> fractions;
  const Progress hears = [&](double fraction, std::string_view) { fractions.push_back(fraction); };
  const std::vector<std::string> names = {"occlusion-aware", "gibbs"};
  score_scene(wall(), Semantics::published, names, {}, hears);
  ASSERT_GT(fractions.size(), 4u);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_LE(fractions.back(), 1.0);
}

TEST(SceneScores, ObeyAStop) {
  std::stop_source stop;
  stop.request_stop();
  for (const char* name : {"occlusion-aware", "gibbs"}) {
    const std::vector<std::string> names = {name};
    EXPECT_THROW(score_scene(wall(), Semantics::published, names, {}, {}, stop.get_token()), Stopped) << name;
  }
}

}  // namespace
}  // namespace nextview

#include <gtest/gtest.h>

#include <algorithm>

#include "core/offline/refinement.hpp"
#include "core/session/session.hpp"
#include "core/study/run_result.hpp"
#include "core/study/shared_by_runs.hpp"
#include "core/view/candidate_views.hpp"
#include "tests/integration/small_scan.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

constexpr const char* text = R"(
[settings]
sensor.width = 160
sensor.height = 120
map.resolution = 0.02
views.count = 12
planner.ray_columns = 16
planner.ray_rows = 12
evaluation.surface_samples = 2000
gibbs.sweeps = 40
object.longest_side = 0.5
[[planning]]
objects = ["sphere", "nowhere.ply"]
policies = ["new-surface"]
views = 4
[[maps]]
objects = ["slotted_plate"]
maps = ["octomap", "gibbs"]
views = 3
)";

class StudyRuns : public testing::Test {
 protected:
  RunResult run(std::size_t i) {
    RunSeconds seconds;
    return perform(study_, study_.run(i), shared_, seconds);
  }
  RunResult run_alone(std::size_t i) const {
    RunSeconds seconds;
    SharedByRuns nothing;
    return perform(study_, study_.run(i), nothing, seconds);
  }
  TemporaryFolder folder_;
  Study study_ = read_study(folder_.write("study.toml", text));
  SharedByRuns shared_;
};

TEST_F(StudyRuns, ProgressNeverGoesBack) {
  for (const std::size_t i : {0u, 2u, 3u}) {  // a plan, a conventional map and a Gibbs map
    std::vector<double> fractions;
    RunSeconds seconds;
    perform(study_, study_.run(i), shared_, seconds, {},
            [&](double fraction, std::string_view) { fractions.push_back(fraction); });
    ASSERT_GT(fractions.size(), 3u) << i;
    EXPECT_TRUE(std::ranges::is_sorted(fractions)) << i << ": " << testing::PrintToString(fractions);
    EXPECT_LE(fractions.back(), 1.0) << i;
  }
}

TEST_F(StudyRuns, APlanIsAScan) {
  const RunResult result = run(0);
  Configuration c = small_scan();
  c.object.longest_side = 0.5;
  c.termination.views = 4;
  Session session(c);
  double path = 0.0, sum = 0.0;
  while (session.finished().empty()) session.step();
  for (const StepRecord& r : session.records()) {
    path += r.motion.distance;
    sum += 100.0 * r.coverage_visible;
    EXPECT_EQ(result.find("coverage[%]", r.step)->value, 100.0 * r.coverage_visible);
    EXPECT_EQ(result.find("entropy[bits]", r.step)->value, r.entropy);
    EXPECT_EQ(result.find("path[m]", r.step)->value, path);
  }
  EXPECT_NEAR(result.find("mean_coverage[%]", 0)->value, sum / 4.0, 1e-9);
}

TEST_F(StudyRuns, WhatRunsShareMakesNoDifference) {
  study_ = read_study(folder_.write("shared.toml", R"(
[settings]
sensor.width = 80
sensor.height = 60
map.resolution = 0.04
views.count = 8
evaluation.surface_samples = 500
gibbs.sweeps = 20
[sensor.noisy]
sensor.width = 80
sensor.height = 60
sensor.range_noise = 0.01
[policy.any_pose]
planner.gain = "random"
evaluation.any_pose = true
[map.strict]
kind = "octomap"
map.hit = 0.9
[map.from_free]
kind = "gibbs"
gibbs.start = "free"
[[planning]]
objects = ["box", "slotted_plate"]
sensors = ["default", "noisy"]
policies = ["oracle", "any_pose"]
seeds = [1, 2]
views = 2
[[maps]]
objects = ["slotted_plate"]
maps = ["octomap", "strict", "gibbs", "from_free"]
views = [3, 4]
)"));
  for (std::size_t i = 0; i < study_.size(); ++i) {
    const RunResult result = run(i);
    EXPECT_EQ(result.failure, "") << i;
    EXPECT_EQ(result.measured, run_alone(i).measured) << study_.run(i).text();
  }
  // One after the other is enough to differ, if anything of the one were taken for the other's.
  EXPECT_NE(run(16).measured, run(17).measured);
  EXPECT_NE(run(18).measured, run(19).measured);
}

TEST_F(StudyRuns, MapsOfTheSameViewsAreMadeOfTheSameScans) {
  run(2);
  shared_.views.name = "those of before";
  run(3);
  EXPECT_EQ(shared_.views.name, "those of before");
  std::string other = text;
  other.replace(other.find("views = 3"), 9, "views = 2");
  study_ = read_study(folder_.write("other.toml", other));
  run(2);
  EXPECT_EQ(shared_.views.name, "slotted_plate") << "other views";
}

TEST_F(StudyRuns, ABrokenObjectIsAResult) {
  EXPECT_NE(run(1).failure.find("nowhere.ply"), std::string::npos);
  EXPECT_TRUE(run(1).measured.empty());
}

TEST_F(StudyRuns, WithoutASensorTheCameraSuitsTheObjectAndAPresetThatSeesNothingSaysSo) {
  std::string small = text;
  small.replace(small.find("map.resolution = 0.02\n"), 22, "");
  small.replace(small.find("longest_side = 0.5"), 18, "longest_side = 0.005");
  study_ = read_study(folder_.write("small.toml", small));
  EXPECT_GT(run(0).find("mean_coverage[%]", 0)->value, 20.0);
  small.replace(small.find("views = 4"), 9, "views = 4\nsensors = [\"paper\"]");
  study_ = read_study(folder_.write("preset.toml", small));
  EXPECT_NE(run(0).failure.find("no view measured anything: "), std::string::npos) << run(0).failure;
  EXPECT_NE(run(0).failure.find("sensor.min_range"), std::string::npos);
}

TEST_F(StudyRuns, AMapIsScoredAsRefineScoresIt) {
  const Configuration c = configuration_of(study_, study_.run(2));
  CandidateViewsConfig around = c.views;
  around.layout = ViewLayout::fibonacci;
  around.count = 3;
  const RefinementJob job = refinement_job(c, candidate_views(around, Vector3::Zero()));
  const Refinement expected = refine(job);
  const RunResult octomap = run(2), gibbs = run(3);
  EXPECT_EQ(octomap.find("log_loss_near_surface[nats]", 0)->value, expected.scores_before->touch_band.log_loss);
  EXPECT_EQ(gibbs.find("log_loss_near_surface[nats]", 0)->value, expected.scores_after->touch_band.log_loss);
  EXPECT_EQ(gibbs.find("rows_open[%]", 0)->value, 100.0 * *expected.scores_after->openings.row_openness());
  EXPECT_EQ(gibbs.find("sweeps", 0)->value, expected.posterior.diagnostics.sweeps);
  EXPECT_EQ(gibbs.find("d_kl_outside_band[%]", 0)->value,
            100.0 * expected.scores_after->touch_visited.divergence_outside_band);
  EXPECT_EQ(gibbs.find("stationary", 0)->value, expected.posterior.diagnostics.stationary ? 1.0 : 0.0);
  // By width, one each: the plate has slots and bores of 10, 20, 30 and 40 mm.
  for (const double width : {10.0, 20.0, 30.0, 40.0})
    EXPECT_TRUE(octomap.find("rows_open_by_width[%]", width)) << width;
}

TEST_F(StudyRuns, AResultComesBackFromItsFileToTheBit) {
  const RunResult result = run(2);
  const RunResult again = read_result(folder_.write("result.json", to_json(result, "0123", study_.run(2))));
  EXPECT_EQ(again.measured, result.measured);
  EXPECT_THROW(read_result(folder_.write("other.json", "{\"failure\": 3}")), std::runtime_error);
}

}  // namespace
}  // namespace nextview

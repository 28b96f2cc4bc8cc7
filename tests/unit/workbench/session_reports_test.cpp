// What the window keeps and says of sessions: log lines, runs, the cloud that was seen, what refining changed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "core/setting/area_text.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/workbench/gated_worker.hpp"
#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class WorkerLog : public GatedWorker {
 protected:
  void expect_last(LogEntry::Level level, const std::string& text) {
    EXPECT_EQ(last_entry().text, text);
    EXPECT_EQ(last_entry().level, level) << text;
  }
  std::string measured() {
    const StepRecord& r = now()->records.back();
    return fmt::format(": {} points, {} of new surface", r.points, area_text(r.new_surface));
  }
};

TEST_F(WorkerLog, SaysOnWhichBranchAViewIsAndWhetherOnlyTheRankingIsAnother) {
  using Level = LogEntry::Level;
  const auto done = [&](SessionRequest request) {
    worker_.post(std::move(request));
    wait_until_idle();
  };
  load();
  step();
  step();
  done(request::Undo{});
  step();
  done(request::GoTo{"main"});
  expect_last(Level::note, "Back at view 2 of 'main'");
  done(request::GoTo{"branch 2", 1});
  expect_last(Level::note, "Back at view 1 of 'branch 2'");
  const std::string ranked = "The candidates are ranked anew; the scan stays";
  done(request::ChangeSetting{"planner.gain", "farthest"});
  expect_last(Level::note, ranked);
  done(request::Undo{});
  expect_last(Level::note, ranked);
  EXPECT_EQ(std::ranges::count(log(), ranked), 2);
}

TEST_F(WorkerLog, HasALineForEachThing) {
  using Level = LogEntry::Level;
  load();
  expect_last(Level::note, fmt::format("sphere: 500 x 500 x 500 mm, {} triangles, 8 candidate views, 40 mm voxels",
                                       now()->mesh->triangles.size()));
  step();
  expect_last(Level::note, "View 1 from the start view" + measured());
  const std::size_t proposed = *now()->proposal(), other = proposed == 3 ? 4 : 3;
  step();
  expect_last(Level::note, fmt::format("View 2 from candidate {}", proposed) + measured());
  worker_.post(request::Undo{});
  wait_until_idle();
  expect_last(Level::note, "Back at view 1");
  worker_.post(request::Redo{});
  wait_until_idle();
  expect_last(Level::note, "At view 2 again");
  worker_.post(request::Undo{});
  wait_until_idle();
  worker_.post(request::TakeView{other});
  step();
  expect_last(Level::note, fmt::format("View 2 from candidate {} (your choice)", other) + measured());
  worker_.post(request::TakeCustomView{custom_view()});
  step();
  expect_last(Level::note, "View 3 from your custom view" + measured());
  worker_.post(request::TakeView{1000});
  wait_until_idle();
  EXPECT_EQ(last_entry().level, Level::warning);
  EXPECT_EQ(last_entry().text, now()->message);
  step();
  expect_last(Level::note, "The scan is finished: " + now()->finished);
  worker_.post(request::Refine{2, 8});
  wait_until_idle();
  expect_last(Level::warning, "Gibbs map of 4 views: " + now()->gibbs->posterior->diagnostics.warning);
  const TemporaryFolder own;
  const auto surface = own.path() / "surface.ply", map = own.path() / "map.ot";
  worker_.post(request::ExportOne{ExportKind::surface, surface, {}, now()->gibbs});
  wait_until_idle();
  expect_last(Level::success, "The surface of the Gibbs map of 4 views: written to " + surface.string());
  worker_.post(request::ExportOne{ExportKind::map, map, {}, now()->gibbs});
  wait_until_idle();
  expect_last(Level::success, "The Gibbs map of 4 views: written to " + map.string());
  const auto folder = own.path() / "scan";
  worker_.post(request::Export{folder});
  wait_until_idle();
  expect_last(Level::success, "Scan written to " + folder.string());
  worker_.post(request::Export{folder});
  wait_until_idle();
  expect_last(Level::warning, folder.string() + ": holds another session: give another name, or open that one");
  worker_.post(request::Export{own.path()});
  wait_until_idle();
  expect_last(Level::warning, own.path().string() + ": is not empty, and holds no session: give another name");
}

TEST_F(WorkerLog, SaysWhichUnitWasGuessed) {
  const TemporaryFolder own;
  Configuration c = small_scan();
  c.object.file = own.path() / "part.ply";
  std::filesystem::copy_file(assets_folder() / "objects" / "box.ply", c.object.file);
  load(c);
  EXPECT_EQ(now()->guessed_unit, "m");
  EXPECT_THAT(last_entry().text, HasSubstr(" (its unit taken as m; object.unit sets it), "));
  c.object.unit = LengthUnit::metres;
  load(c);
  EXPECT_EQ(now()->guessed_unit, "");
  load();
  EXPECT_EQ(now()->guessed_unit, "") << "it comes with the program";
}

TEST_F(WorkerLog, ARankingThatSaysLittleIsAWarning) {
  Configuration c = small_scan();
  c.views.count = 2;
  c.planner.ray_columns = c.planner.ray_rows = 1;
  c.planner.gain = "unobserved-voxel";
  for (const std::string& gain : policy_names())
    if (gain == "rear-side-voxel") c.planner.gain = gain;
  load(c);
  while (now()->finished.empty()) step();
  std::size_t degenerate = 0, warnings = 0;
  for (const StepRecord& r : now()->records) {
    if (r.ranking.degenerate.empty() || &r == &now()->records.back()) continue;  // by the last nothing is chosen
    ++degenerate;
    const std::string line = fmt::format("The ranking after view {} says little: {}", r.step, r.ranking.degenerate);
    for (const LogEntry& entry : *worker_.log().entries())
      warnings += entry.text == line && entry.level == LogEntry::Level::warning;
  }
  EXPECT_GT(degenerate, 0u) << "the scan tells nothing of this";
  EXPECT_EQ(warnings, degenerate);
}

TEST(SessionLog, KeepsTheLatestAndCountsAll) {
  SessionLog log;
  for (int i = 0; i < 503; ++i) log.add(LogEntry::Level::note, std::to_string(i));
  const auto entries = log.entries();
  ASSERT_EQ(entries->size(), SessionLog::most);
  EXPECT_EQ(entries->front().text, "3");
  EXPECT_EQ(entries->back().text, "502");
  EXPECT_EQ(log.told().count, 503u);
}

/// Each run, told apart by its entropies, in the order in which they were made; of too many the oldest go.
TEST_F(SessionRunnerTest, TheNewestRunsAreTheOnesThatStay) {
  Configuration c = small_scan();
  std::vector<std::vector<double>> made;
  runner_.load(c, job_control());
  for (std::size_t run = 0; run < 8; ++run) {
    steps(1 + int(run % 3));
    made.emplace_back();
    for (const StepRecord& r : now().records) made.back().push_back(r.entropy);
    c.views.radius = 0.8 + 0.02 * double(run);
    runner_.load(c, job_control());
    const auto& kept = *now().earlier_runs;
    const std::size_t count = std::min<std::size_t>(made.size(), 6);
    ASSERT_EQ(kept.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<double> entropies;
      for (const StepRecord& r : kept[i].records) entropies.push_back(r.entropy);
      EXPECT_EQ(entropies, made[made.size() - count + i]) << "run " << i << " of " << count;
    }
  }
}

TEST_F(SessionRunnerTest, ARunIsNamedByItsOwnObjectAndGain) {
  Configuration c = small_scan();
  c.planner.gain = "average-entropy";
  runner_.load(c, job_control());
  steps(1);
  c.planner.gain = "random";
  c.object.file = "box";
  runner_.load(c, job_control());
  EXPECT_EQ(now().earlier_runs->back().name, "sphere, average-entropy");
  EXPECT_EQ(now().gain_unit, "");
}

/// What is asked for is what is done, also when only one of the two numbers is another than the last time.
TEST_F(SessionRunnerTest, RefiningTakesNewNumbersOfChainsAndSweeps) {
  runner_.load(small_scan(), job_control());
  steps(1);
  for (const auto& [chains, sweeps] : {std::pair{2, 8}, {2, 12}, {3, 12}, {1, 12}, {1, 8}}) {
    runner_.refine(chains, sweeps, job_control());
    const GibbsMap& gibbs = *now().gibbs;
    EXPECT_EQ(gibbs.config.chains, chains);
    EXPECT_EQ(gibbs.config.sweeps, sweeps);
    EXPECT_EQ(gibbs.posterior->diagnostics.sweeps, sweeps) << "so few are never stationary";
    EXPECT_EQ(gibbs.posterior->diagnostics.log_posterior.size(), std::size_t(chains));
    EXPECT_EQ(gibbs.posterior->diagnostics.log_posterior[0].size(), std::size_t(sweeps));
    EXPECT_EQ(gibbs.posterior->traces.levels.size(), std::size_t(chains));
  }
}

/// Of a sphere it is known how far a point is from the surface.
TEST_F(SessionRunnerTest, TheCloudHasEachPointsViewAndItsDistance) {
  Configuration c = small_scan();
  c.sensor.range_noise = 0.01;
  runner_.load(c, job_control());
  steps(2);
  const SeenCloud& cloud = *now().cloud;
  const double radius = 0.25;
  std::size_t at = 0;
  double largest = 0;
  for (std::size_t view = 0; view < 2; ++view)
    for (const Eigen::Vector3f& point : now().scans[view]->hits) {
      ASSERT_LT(at, cloud.points.size());
      ASSERT_EQ(cloud.points[at], point);
      ASSERT_EQ(cloud.views[at], view);
      ASSERT_NEAR(cloud.distances[at], std::abs(double(point.norm()) - radius), 0.003) << "facets are flat";
      largest = std::max(largest, double(cloud.distances[at++]));
    }
  EXPECT_EQ(at, cloud.points.size());
  EXPECT_GT(largest, 0.01) << "there was no noise";
}

TEST_F(SessionRunnerTest, OfALargeScanEvenlyManyPointsAreKept) {
  Configuration c = small_scan();
  c.sensor.width = 240;
  c.sensor.height = 180;
  c.sensor.field_of_view = 35;
  c.evaluation.enabled = false;
  runner_.load(c, job_control());
  steps(1);
  const auto& hits = now().scans[0]->hits;
  const auto& points = now().cloud->points;
  ASSERT_GT(hits.size(), 8000u) << "the scan tells nothing of this";
  const std::size_t stride = hits.size() / 8000 + 1;
  ASSERT_EQ(points.size(), (hits.size() + stride - 1) / stride);
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(points[i], hits[i * stride]);
}

TEST_F(SessionRunnerTest, WhatIsMissedIsWhatNoPointIsNear) {
  runner_.load(small_scan(), job_control());
  steps(2);
  const MissedPicture& missed = *now().missed;
  const double d_reg = now().configuration.evaluation.d_reg;
  std::size_t seen = 0, unseen = 0;
  for (std::size_t v = 0; v < missed.mesh->vertices.size(); v += 11) {
    double nearest = 1e9;
    for (const auto& scan : now().scans)
      for (const auto& p : scan->hits)
        nearest = std::min(nearest, double((p - missed.mesh->vertices[v].cast<float>()).norm()));
    if (std::abs(nearest - d_reg) < 1e-5) continue;
    EXPECT_EQ(bool(missed.observed[v]), nearest < d_reg) << v;
    ++(nearest < d_reg ? seen : unseen);
  }
  EXPECT_GT(seen, 10u);
  EXPECT_GT(unseen, 10u);
}

TEST(RefinementChange, CountsClassesEntropyAndBins) {
  const auto voxel = [](float p, float entropy, VoxelClass c, bool measured) {
    return Voxel{p, entropy, c, measured, 0};
  };
  using enum VoxelClass;
  const std::vector<Voxel> before{voxel(0.02f, 1, free, true), voxel(0.96f, 2, occupied, true),
                                  voxel(0.5f, 4, unknown, false), voxel(0.5f, 8, unknown, true)};
  const std::vector<Voxel> after{voxel(0.07f, 16, free, true), voxel(1.0f, 32, unknown, true),
                                 voxel(0.3f, 64, free, true), voxel(0.5f, 128, unknown, false)};
  const RefinementChange change = refinement_change(before, after);
  EXPECT_EQ(change.changed_class, 2u);
  EXPECT_EQ(change.entropy_before, 15) << "over all voxels";
  EXPECT_EQ(change.entropy_after, 240);
  std::array<std::size_t, 20> bins_before{}, bins_after{};
  bins_before[0] = bins_before[19] = 1;
  bins_after[1] = bins_after[19] = 1;
  EXPECT_EQ(change.before, bins_before) << "of voxels that both maps know";
  EXPECT_EQ(change.after, bins_after);
}

}  // namespace
}  // namespace nextview

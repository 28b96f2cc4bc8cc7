#include "tests/unit/workbench/session_runner_test.hpp"

#include <gmock/gmock.h>

#include "core/export/scan_files.hpp"
#include "core/file/atomic_file.hpp"
#include "core/map/octree_file.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

TEST_F(SessionRunnerTest, RefiningIsOfTheViewsSoFar) {
  runner_.load(small_scan(), job_control());
  runner_.refine(2, 8, job_control());
  EXPECT_EQ(now().gibbs, nullptr) << "there was no view";
  steps(2);
  const auto before = runner_.snapshot();
  int sampler_reports = 0;
  SessionRunner::JobControl listening = job_control();
  listening.sampler = [&](const SamplerDiagnostics&) { ++sampler_reports; };
  runner_.refine(2, 40, listening);
  const auto first = now().gibbs;
  ASSERT_NE(first, nullptr);
  EXPECT_GT(sampler_reports, 0);
  EXPECT_EQ(first->views, 2u);
  EXPECT_EQ(first->voxels->size(), now().voxels->size());
  EXPECT_EQ(&*now().voxels, &*before->voxels) << "the conventional map is another";
  EXPECT_EQ(now().records.size(), 2u);
  EXPECT_NE(now().map, before->map);
  steps(1);
  EXPECT_EQ(now().gibbs, first) << "it stays until it is made again";
  EXPECT_LT(now().gibbs->views, now().records.size());
  expect_same_scan(now(), *fresh(3));
  runner_.refine(2, 40, job_control());
  EXPECT_EQ(now().gibbs->views, 3u);
  EXPECT_EQ(first->views, 2u);
  runner_.refine(1, 12, job_control());
  EXPECT_EQ(now().gibbs->config.chains, 1);
  EXPECT_EQ(now().gibbs->views, 3u);
  EXPECT_EQ(now().gibbs->posterior->traces.levels.size(), 1u);
  runner_.undo(job_control());
  EXPECT_EQ(now().gibbs, nullptr) << "a map of views that are no more";
  EXPECT_THROW(runner_.refine(0, 8, job_control()), std::invalid_argument);
}

TEST_F(SessionRunnerTest, AnExportKeepsTheGibbsMap) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.refine(2, 8, job_control());
  EXPECT_EQ(now().gibbs_lost, 2u);
  runner_.undo(job_control());
  EXPECT_EQ(now().gibbs_lost, 2u) << "it comes back with its views";
  runner_.redo(job_control());
  runner_.write(folder_ / "export", job_control());
  EXPECT_EQ(now().gibbs_lost, 0u);
  const OccupancyMap written = read_octree(folder_ / "export/posterior.ot");
  EXPECT_EQ(written.grid().resolution, now().grid.resolution);
  runner_.refine(2, 12, job_control());
  EXPECT_EQ(now().gibbs_lost, 2u) << "it is another one";
}

TEST_F(SessionRunnerTest, TheGibbsMapOfAScanThatWasStartedOverComesBackWithIt) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.refine(2, 8, job_control());
  const auto map = now().gibbs;
  runner_.load(small_scan(), job_control());
  EXPECT_EQ(now().gibbs, nullptr);
  EXPECT_EQ(now().gibbs_lost, 0u);
  EXPECT_EQ(now().gibbs_lost_aside, 1u) << "it ends with the program all the same";
  runner_.undo(job_control());
  EXPECT_EQ(now().gibbs, map) << "what may be lost is there to be exported";
  EXPECT_EQ(now().gibbs_lost, 2u);
  EXPECT_EQ(now().gibbs_lost_aside, 0u) << "it counts once";
  runner_.write(folder_ / "export", job_control());
  EXPECT_EQ(now().gibbs_lost, 0u);
  runner_.refine(2, 12, job_control());
  EXPECT_EQ(now().gibbs->views, 2u);
}

TEST_F(SessionRunnerTest, TheGibbsMapComesBackThoughAnotherObjectWasRefinedMeanwhile) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.refine(2, 8, job_control());
  const auto of_sphere = now().gibbs;
  runner_.write(folder_ / "export", job_control());
  runner_.open("box", job_control());
  steps(1);
  runner_.refine(2, 8, job_control());
  EXPECT_EQ(now().gibbs_lost_aside, 0u) << "that of the sphere is in a folder";
  const auto of_box = now().gibbs;
  ASSERT_NE(of_box, of_sphere);
  runner_.undo(job_control());
  runner_.undo(job_control());
  EXPECT_EQ(now().object_name, "sphere");
  EXPECT_EQ(now().gibbs, of_sphere);
  EXPECT_EQ(now().gibbs_lost, 0u) << "it was exported";
  EXPECT_EQ(now().gibbs_lost_aside, 1u) << "that of the box was not, to which redo leads";
  runner_.redo(job_control());
  EXPECT_EQ(now().object_name, "box");
  EXPECT_EQ(now().gibbs, nullptr) << "its view is not there yet";
  runner_.redo(job_control());
  EXPECT_EQ(now().gibbs, of_box);
  EXPECT_EQ(now().gibbs_lost, 1u);
}

TEST_F(SessionRunnerTest, RefiningTwiceIsAsOnceAnew) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.refine(2, 20, job_control());
  SessionRunner other;
  other.load(small_scan(), job_control());
  other.step(job_control());
  other.step(job_control());
  other.refine(2, 20, job_control());
  const auto probability = [](const SessionRunner& runner) {
    std::vector<float> p;
    for (const Voxel& v : *runner.snapshot()->gibbs->voxels) p.push_back(v.probability);
    return p;
  };
  EXPECT_EQ(probability(runner_), probability(other));
  runner_.refine(2, 20, job_control());
  other.refine(2, 20, job_control());
  EXPECT_EQ(probability(runner_), probability(other));
}

TEST_F(SessionRunnerTest, TheChangeCountsWhatTheMapsSay) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.refine(2, 40, job_control());
  const auto& before = *now().voxels;
  const auto& after = *now().gibbs->voxels;
  std::size_t classes = 0, both = 0, in_bins = 0, in_bins_after = 0;
  double entropy = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    classes += before[v].voxel_class != after[v].voxel_class;
    both += before[v].measured && after[v].measured;
    entropy += after[v].entropy;
  }
  const RefinementChange& change = now().gibbs->change;
  for (std::size_t b = 0; b < change.before.size(); ++b) {
    in_bins += change.before[b];
    in_bins_after += change.after[b];
  }
  EXPECT_EQ(change.changed_class, classes);
  EXPECT_EQ(in_bins, both);
  EXPECT_EQ(in_bins_after, both);
  EXPECT_GT(both, 100u);
  EXPECT_NEAR(change.entropy_after, entropy, 1e-9 * entropy);
}

TEST_F(SessionRunnerTest, ACancelledRefinementCanGoOn) {
  runner_.load(small_scan(), job_control());
  steps(2);
  std::stop_source stop;
  SessionRunner::JobControl stopping = job_control();
  stopping.stop = stop.get_token();
  stopping.sampler = [&](const SamplerDiagnostics& so_far) {
    if (so_far.informed_voxels > 0) stop.request_stop();
  };
  runner_.refine(2, 100'000, stopping);
  ASSERT_NE(now().gibbs, nullptr);
  EXPECT_LT(now().gibbs->posterior->diagnostics.sweeps, 1000);
  runner_.refine(2, 30, job_control());
  EXPECT_EQ(now().gibbs->views, 2u);
  std::stop_source stopped;
  stopped.request_stop();
  steps(1);
  const auto before = runner_.snapshot();
  SessionRunner::JobControl never = job_control();
  never.stop = stopped.get_token();
  EXPECT_THROW(runner_.refine(2, 30, never), Stopped);
  EXPECT_EQ(runner_.snapshot(), before);
  runner_.refine(2, 30, job_control());
  EXPECT_EQ(now().gibbs->views, 3u);
}

/// Of fine voxels each sweep takes seconds.
TEST_F(SessionRunnerTest, ARefinementThatIsCancelledBeforeItsFirstMeanMakesNoMoreSweeps) {
  runner_.load(small_scan(), job_control());
  steps(2);
  for (const int last : {0, 1}) {
    std::stop_source stop;
    int sweeps = 0;
    SessionRunner::JobControl stopping = job_control();
    stopping.stop = stop.get_token();
    stopping.sampler = [&](const SamplerDiagnostics& so_far) {
      if ((sweeps = so_far.sweeps) >= last) stop.request_stop();
    };
    EXPECT_THROW(runner_.refine(2, 100'000, stopping), Stopped);
    EXPECT_EQ(now().gibbs, nullptr) << "there is nothing to keep yet";
    EXPECT_LE(sweeps, last + 4) << "that is how often it tells";
  }
}

TEST_F(SessionRunnerTest, ACancelledRefinementKeepsTheMapThatIsThere) {
  runner_.load(small_scan(), job_control());
  steps(1);
  runner_.refine(2, 30, job_control());
  const auto before = runner_.snapshot();
  for (const auto& [chains, sweeps] : {std::pair{2, 30}, {1, 100'000}}) {
    std::stop_source stop;
    SessionRunner::JobControl stopping = job_control();
    stopping.stop = stop.get_token();
    stopping.sampler = [&](const SamplerDiagnostics&) { stop.request_stop(); };
    EXPECT_THROW(runner_.refine(chains, sweeps, stopping), Stopped);
    EXPECT_EQ(runner_.snapshot(), before);
  }
}

TEST_F(SessionRunnerTest, ARefinementThatIsCancelledWhileItMergesEndsAtOnce) {
  runner_.load(small_scan(), job_control());
  steps(3);
  std::stop_source stop;
  int views = 0;
  SessionRunner::JobControl stopping = job_control();
  stopping.stop = stop.get_token();
  stopping.progress = [&](double fraction, std::string_view what) {
    EXPECT_THAT(std::string(what), testing::HasSubstr("merging"));
    EXPECT_NEAR(fraction, 0.0, 0.1) << "that is the least of it";
    if (++views == 2) stop.request_stop();
  };
  const auto before = runner_.snapshot();
  EXPECT_THROW(runner_.refine(2, 30, stopping), Stopped);
  EXPECT_EQ(views, 2) << "the third was merged";
  EXPECT_EQ(runner_.snapshot(), before);
  runner_.refine(2, 30, job_control());
  EXPECT_EQ(now().gibbs->views, 3u) << "it goes on where it was";
}

TEST_F(SessionRunnerTest, ExportsWhatAScanWrites) {
  runner_.load(small_scan(), job_control());
  EXPECT_THROW(runner_.write(folder_ / "none", job_control()), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
  steps(2);
  runner_.take_custom_view(custom_view());
  steps(1);
  runner_.undo(job_control());
  runner_.redo(job_control());
  runner_.write(folder_ / "window", job_control());
  Session session(small_scan());
  session.step();
  session.step();
  session.override_next_view(custom_view());
  session.step();
  OutputFolder out(folder_ / "scan", {});
  out.begin("scan", session.object_file());
  write_scan(session, out);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "scan")) {
    const auto name = entry.path().filename();
    ASSERT_TRUE(std::filesystem::exists(folder_ / "window" / name)) << name;
    if (name == "timings.csv" || name == "manifest.json") continue;  // the latter lists the surfaces too
    { EXPECT_EQ(read_file(folder_ / "window" / name), read_file(entry.path())) << name; }
    ++files;
  }
  EXPECT_GE(files, 8u);
  std::size_t surfaces = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "window"))
    surfaces += !std::filesystem::exists(folder_ / "scan" / entry.path().filename());
  EXPECT_GT(surfaces, 0u) << "the surfaces are not there";
}

TEST_F(SessionRunnerTest, AnExportReplacesNothingThatTheScanWasReadFrom) {
  const auto copy = folder_ / "export" / "cloud.ply";
  std::filesystem::create_directories(folder_ / "export");
  Configuration c = small_scan();
  std::filesystem::copy_file(resolve_object(c.object.file), copy);
  const std::string bytes = read_file(copy);
  c.object.file = copy.string();
  runner_.load(c, job_control());
  steps(1);
  try {
    runner_.write(folder_ / "export", job_control());
    ADD_FAILURE() << "no error";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(copy.string()));
  }
  EXPECT_EQ(read_file(copy), bytes);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "export" / "steps.csv"));
}

TEST_F(SessionRunnerTest, AnExportTellsHowMuchOfEachSurfaceWasSeen) {
  runner_.load(small_scan(), job_control());
  steps(1);
  const auto lines = runner_.write(folder_ / "export", job_control());
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0], testing::HasSubstr("% of it was seen: "));
}

TEST_F(SessionRunnerTest, AnExportThatCannotBeWrittenSaysSo) {
  runner_.load(small_scan(), job_control());
  steps(1);
  write_file(folder_ / "file", "x");
  try {
    runner_.write(folder_ / "file", job_control());
    ADD_FAILURE() << "no error";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr((folder_ / "file").string()));
  }
}

TEST_F(SessionRunnerTest, EarlierRunsStayForTheirCurves) {
  Configuration c = small_scan();
  runner_.load(c, job_control());
  runner_.load(c, job_control());
  EXPECT_EQ(now().earlier_runs, nullptr) << "a run without views has no curve";
  for (int run = 0; run < 8; ++run) {
    steps(1 + run % 2);
    c.seed = std::uint64_t(run + 2);
    runner_.load(c, job_control());
  }
  ASSERT_NE(now().earlier_runs, nullptr);
  const auto& runs = *now().earlier_runs;
  ASSERT_EQ(runs.size(), 6u) << "the oldest ones go";
  EXPECT_EQ(runs.back().records.size(), 2u);
  EXPECT_EQ(runs.front().records.size(), 1u);
  EXPECT_EQ(runs.front().name, "sphere, new-surface");
  for (const nextview::Run& run : runs)
    for (const StepRecord& record : run.records) EXPECT_TRUE(record.candidates.empty());
  steps(1);
  EXPECT_EQ(now().earlier_runs->size(), 6u);
  runner_.forget_runs();
  EXPECT_EQ(now().earlier_runs, nullptr);
  EXPECT_EQ(now().records.size(), 1u);
}

TEST_F(SessionRunnerTest, WithoutEvaluationThereIsNoTruth) {
  Configuration c = small_scan();
  c.evaluation.enabled = false;
  runner_.load(c, job_control());
  steps(2);
  EXPECT_EQ(now().truth, nullptr);
  EXPECT_EQ(now().missed, nullptr);
  EXPECT_TRUE(now().cloud->distances.empty());
  EXPECT_FALSE(now().cloud->points.empty());
  EXPECT_EQ(now().cloud->views.size(), now().cloud->points.size());
}

TEST_F(SessionRunnerTest, AMessageGoesWithWhatWorksNext) {
  runner_.load(small_scan(), job_control());
  runner_.set_message("no");
  EXPECT_EQ(now().message, "no");
  EXPECT_TRUE(now().loaded());
  steps(1);
  EXPECT_EQ(now().message, "");
}

}  // namespace
}  // namespace nextview

#include "ui/window/session_runner.hpp"

#include <gmock/gmock.h>

#include "core/file/atomic_file.hpp"
#include "core/session/scan_files.hpp"
#include "core/session/stopped.hpp"
#include "tests/unit/map/temporary_folder.hpp"
#include "tests/unit/window/small_scan.hpp"

namespace nextview {
namespace {

SessionRunner::Told told() {
  return {[](double, std::string_view) {}, [](const SamplerDiagnostics&) {}, {}};
}

Pose own_view() { return look_at(Vector3(0.31, -0.62, 0.47), Vector3(0.02, 0.01, -0.03)); }

bool same_candidates(const std::vector<Candidate>& a, const std::vector<Candidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Candidate& x, const Candidate& y) {
    return x.available == y.available && x.gain == y.gain && x.cost == y.cost && x.utility == y.utility;
  });
}

/// All that a snapshot says of the scan, to the bit; seconds aside.
void expect_same_scan(const SessionSnapshot& a, const SessionSnapshot& b) {
  EXPECT_EQ(to_toml(a.configuration), to_toml(b.configuration));
  EXPECT_EQ(a.object_name, b.object_name);
  EXPECT_EQ(a.finished, b.finished);
  EXPECT_EQ(a.next_candidate, b.next_candidate);
  EXPECT_EQ(a.next_view.matrix(), b.next_view.matrix());
  EXPECT_EQ(a.own_next_view, b.own_next_view);
  EXPECT_EQ(a.explanation != nullptr, b.explanation != nullptr);
  if (a.explanation && b.explanation) {
    EXPECT_EQ(a.explanation->value, b.explanation->value);
  }
  ASSERT_EQ(a.records.size(), b.records.size());
  for (std::size_t k = 0; k < a.records.size(); ++k) {
    const StepRecord &x = a.records[k], &y = b.records[k];
    EXPECT_EQ(x.view, y.view) << k;
    EXPECT_EQ(x.overridden, y.overridden) << k;
    EXPECT_EQ(x.T_world_camera.matrix(), y.T_world_camera.matrix()) << k;
    EXPECT_EQ(x.gain, y.gain) << k;
    EXPECT_EQ(x.entropy, y.entropy) << k;
    EXPECT_EQ(x.coverage, y.coverage) << k;
    EXPECT_EQ(x.realised_gain, y.realised_gain) << k;
    EXPECT_TRUE(same_candidates(x.candidates, y.candidates)) << k;
    EXPECT_EQ(a.scans[k]->returns, b.scans[k]->returns) << k;
    EXPECT_EQ(a.scans[k]->passes, b.scans[k]->passes) << k;
  }
  EXPECT_TRUE(std::equal(a.voxels->begin(), a.voxels->end(), b.voxels->begin(), b.voxels->end(),
                         [](const Voxel& x, const Voxel& y) {
                           return x.probability == y.probability && x.measured == y.measured &&
                                  x.occlusion_distance == y.occlusion_distance;
                         }));
  EXPECT_EQ(a.cloud->points, b.cloud->points);
  EXPECT_EQ(a.cloud->views, b.cloud->views);
  EXPECT_EQ(a.cloud->distances, b.cloud->distances);
  if (a.missed && b.missed) {
    EXPECT_EQ(a.missed->observed, b.missed->observed);
  }
}

class SessionRunnerTest : public TemporaryFolder {
 protected:
  const SessionSnapshot& now() { return *runner_.snapshot(); }
  void steps(int count) {
    for (int i = 0; i < count; ++i) runner_.step(told());
  }
  /// What a person sees who never did anything else than this.
  static std::shared_ptr<const SessionSnapshot> fresh(int steps, const Configuration& configuration = small_scan()) {
    SessionRunner runner;
    runner.load(configuration, told());
    for (int i = 0; i < steps; ++i) runner.step(told());
    return runner.snapshot();
  }

  SessionRunner runner_;
};

TEST_F(SessionRunnerTest, NothingWorksOnNothing) {
  EXPECT_FALSE(now().can_undo || now().can_redo || runner_.can_step());
  const auto before = runner_.snapshot();
  runner_.undo(told());
  runner_.redo(told());
  runner_.step(told());
  runner_.take_view(0);
  runner_.take_own_view(own_view());
  runner_.refine(1, 4, told());
  EXPECT_EQ(runner_.snapshot(), before);
  EXPECT_THROW(runner_.write("/tmp/nextview-no-such-scan", told()), std::invalid_argument);
}

TEST_F(SessionRunnerTest, UndoIsAsIfTheStepHadNeverBeen) {
  runner_.load(small_scan(), told());
  EXPECT_FALSE(now().can_undo) << "there is nothing before the first session";
  steps(3);
  EXPECT_TRUE(now().can_undo);
  EXPECT_FALSE(now().can_redo);
  for (int left = 2; left >= 0; --left) {
    runner_.undo(told());
    EXPECT_TRUE(now().can_redo);
    expect_same_scan(now(), *fresh(left));
  }
  EXPECT_FALSE(now().can_undo);
  const auto first = runner_.snapshot();
  runner_.undo(told());
  EXPECT_EQ(runner_.snapshot(), first) << "there was nothing left to undo";
}

TEST_F(SessionRunnerTest, RedoIsTheSameStep) {
  runner_.load(small_scan(), told());
  steps(3);
  const auto all = runner_.snapshot();
  for (int i = 0; i < 3; ++i) runner_.undo(told());
  for (int i = 0; i < 3; ++i) runner_.redo(told());
  EXPECT_FALSE(now().can_redo);
  expect_same_scan(now(), *all);
  EXPECT_EQ(now().session, all->session) << "the scan is the same one";
  steps(1);
  expect_same_scan(now(), *fresh(4));
}

TEST_F(SessionRunnerTest, AStepOnAnotherWayForgetsTheOldOne) {
  runner_.load(small_scan(), told());
  steps(3);
  runner_.undo(told());
  steps(1);
  EXPECT_FALSE(now().can_redo);
  expect_same_scan(now(), *fresh(3));
  runner_.undo(told());
  runner_.undo(told());
  runner_.load(small_scan(), told());
  EXPECT_FALSE(now().can_redo);
}

TEST_F(SessionRunnerTest, OverridesAreUndoneAndRedone) {
  runner_.load(small_scan(), told());
  steps(1);
  const std::size_t other = now().proposal() == 2 ? 3 : 2;
  runner_.take_view(other);
  EXPECT_EQ(now().next_candidate, other);
  steps(1);
  EXPECT_TRUE(now().records[1].overridden);
  EXPECT_EQ(now().records[1].view, int(other));
  runner_.take_own_view(own_view());
  EXPECT_TRUE(now().own_next_view);
  EXPECT_FALSE(now().next_candidate);
  ASSERT_NE(now().explanation, nullptr);
  const double expected = now().explanation->value;
  steps(1);
  EXPECT_FALSE(now().own_next_view);
  EXPECT_EQ(now().records[2].view, -1);
  EXPECT_NEAR(now().records[2].gain, expected, 1e-9 * expected);
  EXPECT_TRUE(now().records[2].T_world_camera.isApprox(own_view(), 1e-12));
  const auto all = runner_.snapshot();
  runner_.undo(told());
  EXPECT_TRUE(now().records[1].overridden);
  EXPECT_EQ(now().next_candidate, now().proposal()) << "it is the planner's turn again";
  runner_.undo(told());
  expect_same_scan(now(), *fresh(1));
  runner_.redo(told());
  runner_.redo(told());
  expect_same_scan(now(), *all);
  steps(1);
  EXPECT_FALSE(now().records[3].overridden);
}

TEST_F(SessionRunnerTest, AnOverrideThatIsNotTakenLeavesNoTrace) {
  runner_.load(small_scan(), told());
  steps(2);
  runner_.take_own_view(own_view());
  runner_.take_view(*now().proposal());
  EXPECT_FALSE(now().own_next_view);
  steps(1);
  expect_same_scan(now(), *fresh(3));
  runner_.take_view(*now().proposal());
  runner_.undo(told());
  steps(1);
  expect_same_scan(now(), *fresh(3));
}

TEST_F(SessionRunnerTest, UndoGoesBackAcrossObjectsAndSettings) {
  runner_.load(small_scan(), told());
  steps(2);
  const auto sphere = runner_.snapshot();
  Configuration other = small_scan();
  other.object.file = "box";
  other.map.resolution = 0.05;
  runner_.load(other, told());
  steps(1);
  const auto box = runner_.snapshot();
  EXPECT_GT(box->session, sphere->session);
  runner_.undo(told());
  expect_same_scan(now(), *fresh(0, other));
  runner_.undo(told());
  expect_same_scan(now(), *sphere);
  EXPECT_NE(now().session, box->session) << "what is selected belongs to another scan";
  runner_.redo(told());
  runner_.redo(told());
  expect_same_scan(now(), *box);
  EXPECT_FALSE(now().can_redo);
}

TEST_F(SessionRunnerTest, UndoBringsBackWhatWasResetOrFinished) {
  runner_.load(small_scan(), told());
  steps(4);
  EXPECT_FALSE(now().finished.empty());
  const auto finished = runner_.snapshot();
  steps(1);
  EXPECT_EQ(runner_.snapshot(), finished) << "a finished scan takes no step";
  runner_.load(runner_.configuration(), told());
  EXPECT_TRUE(now().records.empty());
  runner_.undo(told());
  expect_same_scan(now(), *finished);
  runner_.undo(told());
  EXPECT_TRUE(now().finished.empty());
  steps(1);
  expect_same_scan(now(), *finished);
}

TEST_F(SessionRunnerTest, ACancelledUndoLeavesAllAsItWas) {
  runner_.load(small_scan(), told());
  steps(3);
  runner_.undo(told());
  const auto before = runner_.snapshot();
  using Travel = void (SessionRunner::*)(const SessionRunner::Told&);
  for (const auto& [travel, from] : {std::pair<Travel, double>{&SessionRunner::undo, 0.0},
                                     {&SessionRunner::undo, 0.3},
                                     {&SessionRunner::redo, 0.0},
                                     {&SessionRunner::redo, 0.5},
                                     {&SessionRunner::redo, 0.7}}) {
    std::stop_source stop;
    SessionRunner::Told stopping = told();
    stopping.stop = stop.get_token();
    stopping.progress = [&, begin = from](double fraction, std::string_view) {
      if (fraction >= begin) stop.request_stop();
    };
    EXPECT_ANY_THROW((runner_.*travel)(stopping)) << from;
    EXPECT_EQ(runner_.snapshot(), before);
  }
  expect_same_scan(now(), *fresh(2));
  runner_.redo(told());
  expect_same_scan(now(), *fresh(3));
}

TEST_F(SessionRunnerTest, ALoadThatFailsLeavesAllAsItWas) {
  runner_.load(small_scan(), told());
  steps(2);
  runner_.undo(told());
  const auto before = runner_.snapshot();
  Configuration bad = small_scan();
  bad.object.file = "/no/such/file.ply";
  EXPECT_ANY_THROW(runner_.load(bad, told()));
  EXPECT_EQ(runner_.snapshot(), before);
  runner_.redo(told());
  expect_same_scan(now(), *fresh(2));
  EXPECT_ANY_THROW(runner_.take_view(1000));
  EXPECT_ANY_THROW(runner_.take_view(std::size_t(now().records[1].view))) << "it was taken already";
  Pose bent = own_view();
  bent.linear() *= 2;
  EXPECT_ANY_THROW(runner_.take_own_view(bent));
  steps(1);
  expect_same_scan(now(), *fresh(3));
}

TEST_F(SessionRunnerTest, RefiningIsOfTheViewsSoFar) {
  runner_.load(small_scan(), told());
  runner_.refine(2, 8, told());
  EXPECT_EQ(now().gibbs, nullptr) << "there was no view";
  steps(2);
  const auto before = runner_.snapshot();
  int told_of_sampler = 0;
  SessionRunner::Told listening = told();
  listening.sampler = [&](const SamplerDiagnostics&) { ++told_of_sampler; };
  runner_.refine(2, 40, listening);
  const auto first = now().gibbs;
  ASSERT_NE(first, nullptr);
  EXPECT_GT(told_of_sampler, 0);
  EXPECT_EQ(first->views, 2u);
  EXPECT_EQ(first->voxels.size(), now().voxels->size());
  EXPECT_EQ(now().voxels, before->voxels) << "the conventional map is another";
  EXPECT_EQ(now().records.size(), 2u);
  EXPECT_NE(now().map, before->map);
  steps(1);
  EXPECT_EQ(now().gibbs, first) << "it stays until it is made again";
  EXPECT_LT(now().gibbs->views, now().records.size());
  expect_same_scan(now(), *fresh(3));
  runner_.refine(2, 40, told());
  EXPECT_EQ(now().gibbs->views, 3u);
  EXPECT_EQ(first->views, 2u);
  runner_.refine(1, 12, told());
  EXPECT_EQ(now().gibbs->config.chains, 1);
  EXPECT_EQ(now().gibbs->views, 3u);
  EXPECT_EQ(now().gibbs->posterior.traces.levels.size(), 1u);
  runner_.undo(told());
  EXPECT_EQ(now().gibbs, nullptr) << "a map of views that are no more";
  EXPECT_THROW(runner_.refine(0, 8, told()), std::invalid_argument);
}

TEST_F(SessionRunnerTest, RefiningTwiceIsAsOnceAnew) {
  runner_.load(small_scan(), told());
  steps(2);
  runner_.refine(2, 20, told());
  SessionRunner other;
  other.load(small_scan(), told());
  other.step(told());
  other.step(told());
  other.refine(2, 20, told());
  const auto probability = [](const SessionRunner& runner) {
    std::vector<float> p;
    for (const Voxel& v : runner.snapshot()->gibbs->voxels) p.push_back(v.probability);
    return p;
  };
  EXPECT_EQ(probability(runner_), probability(other));
  runner_.refine(2, 20, told());
  other.refine(2, 20, told());
  EXPECT_EQ(probability(runner_), probability(other));
}

TEST_F(SessionRunnerTest, TheChangeCountsWhatTheMapsSay) {
  runner_.load(small_scan(), told());
  steps(2);
  runner_.refine(2, 40, told());
  const auto& before = *now().voxels;
  const auto& after = now().gibbs->voxels;
  std::size_t classes = 0, both = 0, in_bins = 0, in_bins_after = 0;
  double entropy = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    classes += before[v].voxel_class != after[v].voxel_class;
    both += before[v].measured && after[v].measured;
    entropy += after[v].entropy;
  }
  const MapChange& change = now().gibbs->change;
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
  runner_.load(small_scan(), told());
  steps(2);
  std::stop_source stop;
  SessionRunner::Told stopping = told();
  stopping.stop = stop.get_token();
  stopping.sampler = [&](const SamplerDiagnostics&) { stop.request_stop(); };
  runner_.refine(2, 100'000, stopping);
  ASSERT_NE(now().gibbs, nullptr);
  EXPECT_LT(now().gibbs->posterior.diagnostics.sweeps, 1000);
  runner_.refine(2, 30, told());
  EXPECT_EQ(now().gibbs->views, 2u);
  std::stop_source stopped;
  stopped.request_stop();
  steps(1);
  const auto before = runner_.snapshot();
  SessionRunner::Told never = told();
  never.stop = stopped.get_token();
  EXPECT_THROW(runner_.refine(2, 30, never), Stopped);
  EXPECT_EQ(runner_.snapshot(), before);
  runner_.refine(2, 30, told());
  EXPECT_EQ(now().gibbs->views, 3u);
}

TEST_F(SessionRunnerTest, ExportsWhatAScanWrites) {
  runner_.load(small_scan(), told());
  EXPECT_THROW(runner_.write(folder_ / "none", told()), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
  steps(2);
  runner_.take_own_view(own_view());
  steps(1);
  runner_.undo(told());
  runner_.redo(told());
  runner_.write(folder_ / "window", told());
  Session session(small_scan());
  session.step();
  session.step();
  session.override_next_view(own_view());
  session.step();
  prepare_output_folder(folder_ / "scan");
  write_scan(session, folder_ / "scan");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "scan")) {
    const auto name = entry.path().filename();
    ASSERT_TRUE(std::filesystem::exists(folder_ / "window" / name)) << name;
    if (name == "timings.csv") continue;
    { EXPECT_EQ(read_file(folder_ / "window" / name), read_file(entry.path())) << name; }
    ++files;
  }
  EXPECT_GE(files, 8u);
  std::size_t surfaces = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "window"))
    surfaces += !std::filesystem::exists(folder_ / "scan" / entry.path().filename());
  EXPECT_GT(surfaces, 0u) << "the surfaces are not there";
}

TEST_F(SessionRunnerTest, AnExportThatCannotBeWrittenSaysSo) {
  runner_.load(small_scan(), told());
  steps(1);
  write_file(folder_ / "file", "x");
  try {
    runner_.write(folder_ / "file", told());
    ADD_FAILURE() << "no error";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr((folder_ / "file").string()));
  }
}

TEST_F(SessionRunnerTest, EarlierRunsStayForTheirCurves) {
  Configuration c = small_scan();
  runner_.load(c, told());
  runner_.load(c, told());
  EXPECT_EQ(now().earlier_runs, nullptr) << "a run without views has no curve";
  for (int run = 0; run < 8; ++run) {
    steps(1 + run % 2);
    c.seed = std::uint64_t(run + 2);
    runner_.load(c, told());
  }
  ASSERT_NE(now().earlier_runs, nullptr);
  const auto& runs = *now().earlier_runs;
  ASSERT_EQ(runs.size(), 6u) << "the oldest ones go";
  EXPECT_EQ(runs.back().records.size(), 2u);
  EXPECT_EQ(runs.front().records.size(), 1u);
  EXPECT_EQ(runs.front().name, "sphere, occlusion-aware");
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
  runner_.load(c, told());
  steps(2);
  EXPECT_EQ(now().truth, nullptr);
  EXPECT_EQ(now().missed, nullptr);
  EXPECT_TRUE(now().cloud->distances.empty());
  EXPECT_FALSE(now().cloud->points.empty());
  EXPECT_EQ(now().cloud->views.size(), now().cloud->points.size());
}

TEST_F(SessionRunnerTest, AMessageGoesWithWhatWorksNext) {
  runner_.load(small_scan(), told());
  runner_.set_message("no");
  EXPECT_EQ(now().message, "no");
  EXPECT_TRUE(now().loaded());
  steps(1);
  EXPECT_EQ(now().message, "");
}

}  // namespace
}  // namespace nextview

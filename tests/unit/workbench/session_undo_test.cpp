#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {
namespace {

TEST_F(SessionRunnerTest, NothingWorksOnNothing) {
  EXPECT_FALSE(now().can_undo || now().can_redo || runner_.can_step());
  const auto before = runner_.snapshot();
  runner_.undo(job_control());
  runner_.redo(job_control());
  runner_.step(job_control());
  runner_.take_view(0);
  runner_.take_custom_view(custom_view());
  runner_.refine(1, 4, job_control());
  EXPECT_EQ(runner_.snapshot(), before);
  EXPECT_THROW(runner_.write("/tmp/nextview-no-such-scan", job_control()), std::invalid_argument);
}

TEST_F(SessionRunnerTest, UndoIsAsIfTheStepHadNeverBeen) {
  runner_.load(small_scan(), job_control());
  EXPECT_FALSE(now().can_undo) << "there is nothing before the first session";
  steps(3);
  EXPECT_TRUE(now().can_undo);
  EXPECT_FALSE(now().can_redo);
  for (int left = 2; left >= 0; --left) {
    runner_.undo(job_control());
    EXPECT_TRUE(now().can_redo);
    expect_same_scan(now(), *fresh(left));
  }
  EXPECT_FALSE(now().can_undo);
  const auto first = runner_.snapshot();
  runner_.undo(job_control());
  EXPECT_EQ(runner_.snapshot(), first) << "there was nothing left to undo";
}

TEST_F(SessionRunnerTest, RedoIsTheSameStep) {
  runner_.load(small_scan(), job_control());
  steps(3);
  const auto all = runner_.snapshot();
  for (int i = 0; i < 3; ++i) runner_.undo(job_control());
  for (int i = 0; i < 3; ++i) runner_.redo(job_control());
  EXPECT_FALSE(now().can_redo);
  expect_same_scan(now(), *all);
  EXPECT_EQ(now().session, all->session) << "the scan is the same one";
  steps(1);
  expect_same_scan(now(), *fresh(4));
}

TEST_F(SessionRunnerTest, AStepOnAnotherWayForgetsTheOldOne) {
  runner_.load(small_scan(), job_control());
  steps(3);
  runner_.undo(job_control());
  steps(1);
  EXPECT_FALSE(now().can_redo);
  expect_same_scan(now(), *fresh(3));
  runner_.undo(job_control());
  runner_.undo(job_control());
  runner_.load(small_scan(), job_control());
  EXPECT_FALSE(now().can_redo);
}

TEST_F(SessionRunnerTest, OverridesAreUndoneAndRedone) {
  runner_.load(small_scan(), job_control());
  steps(1);
  const std::size_t other = now().proposal() == 2 ? 3 : 2;
  runner_.take_view(other);
  EXPECT_EQ(now().next_candidate, other);
  steps(1);
  EXPECT_TRUE(now().records[1].overridden);
  EXPECT_EQ(now().records[1].view, int(other));
  runner_.take_custom_view(custom_view());
  EXPECT_TRUE(now().custom_next_view);
  EXPECT_FALSE(now().next_candidate);
  ASSERT_NE(now().explanation, nullptr);
  const double expected = now().explanation->value;
  steps(1);
  EXPECT_FALSE(now().custom_next_view);
  EXPECT_EQ(now().records[2].view, -1);
  EXPECT_NEAR(now().records[2].gain, expected, 1e-9 * expected);
  EXPECT_TRUE(now().records[2].T_world_camera.isApprox(custom_view(), 1e-12));
  const auto all = runner_.snapshot();
  runner_.undo(job_control());
  EXPECT_TRUE(now().records[1].overridden);
  EXPECT_EQ(now().next_candidate, now().proposal()) << "it is the planner's turn again";
  runner_.undo(job_control());
  expect_same_scan(now(), *fresh(1));
  runner_.redo(job_control());
  runner_.redo(job_control());
  expect_same_scan(now(), *all);
  steps(1);
  EXPECT_FALSE(now().records[3].overridden);
}

TEST_F(SessionRunnerTest, AnOverrideThatIsNotTakenLeavesNoTrace) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.take_custom_view(custom_view());
  runner_.take_view(*now().proposal());
  EXPECT_FALSE(now().custom_next_view);
  steps(1);
  expect_same_scan(now(), *fresh(3));
  runner_.take_view(*now().proposal());
  runner_.undo(job_control());
  steps(1);
  expect_same_scan(now(), *fresh(3));
}

TEST_F(SessionRunnerTest, UndoGoesBackAcrossObjectsAndSettings) {
  runner_.load(small_scan(), job_control());
  steps(2);
  const auto sphere = runner_.snapshot();
  Configuration other = small_scan();
  other.object.file = "box";
  other.map.resolution = 0.05;
  runner_.load(other, job_control());
  steps(1);
  const auto box = runner_.snapshot();
  EXPECT_GT(box->session, sphere->session);
  runner_.undo(job_control());
  expect_same_scan(now(), *fresh(0, other));
  runner_.undo(job_control());
  expect_same_scan(now(), *sphere);
  EXPECT_NE(now().session, box->session) << "what is selected belongs to another scan";
  runner_.redo(job_control());
  runner_.redo(job_control());
  expect_same_scan(now(), *box);
  EXPECT_FALSE(now().can_redo);
}

TEST_F(SessionRunnerTest, UndoBringsBackWhatWasResetOrFinished) {
  runner_.load(small_scan(), job_control());
  steps(4);
  EXPECT_FALSE(now().finished.empty());
  const auto finished = runner_.snapshot();
  steps(1);
  EXPECT_EQ(runner_.snapshot(), finished) << "a finished scan takes no step";
  runner_.load(runner_.configuration(), job_control());
  EXPECT_TRUE(now().records.empty());
  runner_.undo(job_control());
  expect_same_scan(now(), *finished);
  runner_.undo(job_control());
  EXPECT_TRUE(now().finished.empty());
  steps(1);
  expect_same_scan(now(), *finished);
}

TEST_F(SessionRunnerTest, UndoAndRedoOfKeptViewsTakeNothingAnew) {
  for (const char* gain : {"proximity-count", "gibbs"}) {
    Configuration c = small_scan();
    c.planner.gain = gain;
    c.gibbs.view_sweeps = 8;
    runner_.load(c, job_control());
    steps(3);
    const auto all = runner_.snapshot();
    std::stop_source stop;
    stop.request_stop();
    const SessionRunner::JobControl nobody{[](double, std::string_view what) { ADD_FAILURE() << what; },
                                           [](const SamplerDiagnostics&) { ADD_FAILURE(); }, stop.get_token()};
    for (int left = 2; left >= 0; --left) {
      runner_.undo(nobody);
      expect_same_scan(now(), *fresh(left, c));
      for (int k = 0; k < left; ++k) EXPECT_EQ(now().scans[k], all->scans[k]);
    }
    for (int i = 0; i < 3; ++i) runner_.redo(nobody);
    expect_same_scan(now(), *all);
    EXPECT_EQ(now().scans, all->scans);
  }
}

/// Six views whose maps are not kept.
Configuration forgetful(const std::string& gain = "proximity-count") {
  Configuration c = small_scan();
  c.termination.views = 6;
  c.planner.gain = gain;
  c.gibbs.view_sweeps = 8;
  c.history.memory = 0.0;
  return c;
}

TEST_F(SessionRunnerTest, MapsThatAreNotKeptAreMadeAgainTheSame) {
  for (const auto& [gain, semantics] : {std::pair{"proximity-count", Semantics::published},
                                        {"gibbs", Semantics::published},
                                        {"oracle", Semantics::published},
                                        {"area-factor", Semantics::reference}}) {
    SCOPED_TRACE(gain);
    Configuration c = forgetful(gain);
    c.planner.semantics = semantics;
    runner_.load(c, job_control());
    steps(4);
    const auto all = runner_.snapshot();
    std::size_t reports = 0;
    SessionRunner::JobControl listening = job_control();
    listening.progress = [&](double fraction, std::string_view what) {
      ++reports;
      EXPECT_EQ(what, "making the map again");
      EXPECT_TRUE(fraction >= 0.0 && fraction <= 1.0) << fraction;
    };
    for (int left = 3; left >= 0; --left) {
      runner_.undo(listening);
      expect_same_scan(now(), *fresh(left, c));
    }
    EXPECT_GT(reports, 0u);
    for (int i = 0; i < 4; ++i) runner_.redo(listening);
    expect_same_scan(now(), *all);
    steps(1);
    expect_same_scan(now(), *fresh(5, c));
  }
}

TEST_F(SessionRunnerTest, ACancelledUndoLeavesAllAsItWas) {
  const Configuration c = forgetful();
  runner_.load(c, job_control());
  steps(5);
  runner_.undo(job_control());
  const auto before = runner_.snapshot();
  using Travel = void (SessionRunner::*)(const SessionRunner::JobControl&);
  for (const auto& [travel, from] : {std::pair<Travel, double>{&SessionRunner::undo, 0.0},
                                     {&SessionRunner::undo, 0.3},
                                     {&SessionRunner::undo, 0.6},
                                     {&SessionRunner::redo, 0.0},
                                     {&SessionRunner::redo, 0.7}}) {
    std::stop_source stop;
    SessionRunner::JobControl stopping = job_control();
    stopping.stop = stop.get_token();
    stopping.progress = [&, begin = from](double fraction, std::string_view) {
      if (fraction >= begin) stop.request_stop();
    };
    EXPECT_ANY_THROW((runner_.*travel)(stopping)) << from;
    EXPECT_EQ(runner_.snapshot(), before);
  }
  expect_same_scan(now(), *fresh(4, c));
  runner_.redo(job_control());
  expect_same_scan(now(), *fresh(5, c));
}

/// The planner's own Gibbs map goes back with the views.
TEST_F(SessionRunnerTest, AMapOfViewsThatAreNoMoreIsNotShown) {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  c.gibbs.view_sweeps = 8;
  runner_.load(c, job_control());
  steps(2);
  EXPECT_EQ(now().gibbs->views, 2u);
  runner_.undo(job_control());
  EXPECT_EQ(now().gibbs->views, 1u);
  runner_.undo(job_control());
  EXPECT_EQ(now().gibbs, nullptr);
  runner_.redo(job_control());
  EXPECT_EQ(now().gibbs->views, 1u);
}

/// Nor if a later refinement was cancelled before it had all of them.
TEST_F(SessionRunnerTest, AMapOfViewsThatAreNoMoreIsNotShownAfterACancelledRefinement) {
  runner_.load(small_scan(), job_control());
  steps(3);
  runner_.refine(2, 8, job_control());
  std::stop_source stop;
  SessionRunner::JobControl cancelled = job_control();
  cancelled.stop = stop.get_token();
  cancelled.progress = [&](double fraction, std::string_view) {
    if (fraction > 0) stop.request_stop();
  };
  EXPECT_ANY_THROW(runner_.refine(1, 8, cancelled));
  EXPECT_EQ(now().gibbs->views, 3u) << "the one before is still there";
  runner_.undo(job_control());
  EXPECT_EQ(now().gibbs, nullptr);
}

/// What the window refined beside the planner's own map is made anew of other views.
TEST_F(SessionRunnerTest, RefiningBesideThePlannersMapIsOfTheViewsThatThereAre) {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  c.gibbs.view_sweeps = 8;
  runner_.load(c, job_control());
  steps(2);
  runner_.refine(2, 8, job_control());
  runner_.undo(job_control());
  const auto candidate = now().proposal() == 0u ? 1u : 0u;
  runner_.take_view(candidate);
  runner_.step(job_control());
  runner_.refine(2, 8, job_control());
  SessionRunner other;
  other.load(c, job_control());
  other.step(job_control());
  other.take_view(candidate);
  other.step(job_control());
  other.refine(2, 8, job_control());
  EXPECT_EQ(now().gibbs->posterior->occupied, other.snapshot()->gibbs->posterior->occupied);
}

TEST_F(SessionRunnerTest, ALoadThatFailsLeavesAllAsItWas) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.undo(job_control());
  const auto before = runner_.snapshot();
  Configuration bad = small_scan();
  bad.object.file = "/no/such/file.ply";
  EXPECT_ANY_THROW(runner_.load(bad, job_control()));
  EXPECT_EQ(runner_.snapshot(), before);
  runner_.redo(job_control());
  expect_same_scan(now(), *fresh(2));
  EXPECT_ANY_THROW(runner_.take_view(1000));
  EXPECT_ANY_THROW(runner_.take_view(std::size_t(now().records[1].view))) << "it was taken already";
  Pose bent = custom_view();
  bent.linear() *= 2;
  EXPECT_ANY_THROW(runner_.take_custom_view(bent));
  steps(1);
  expect_same_scan(now(), *fresh(3));
}

}  // namespace
}  // namespace nextview

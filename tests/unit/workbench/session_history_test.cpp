// What the way back costs: states that are kept, and maps that are made again.
#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {
namespace {

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
  c.termination.surface_left = 0.0;
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

Configuration planned_on_gibbs_map() {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  c.gibbs.view_sweeps = 8;
  return c;
}

/// The planner's own Gibbs map goes back with the views.
TEST_F(SessionRunnerTest, AMapOfViewsThatAreNoMoreIsNotShown) {
  const Configuration c = planned_on_gibbs_map();
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
  const Configuration c = planned_on_gibbs_map();
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

}  // namespace
}  // namespace nextview

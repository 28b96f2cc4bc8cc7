// Sessions with branches that are kept, and opened again.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/journal/journal.hpp"
#include "tests/unit/workbench/kept_folder.hpp"
#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using KeptBranches = SessionRunnerTest;

TEST_F(KeptBranches, AreThereWhenASessionIsOpened) {
  for (const double memory : {1.0, 0.0}) {
    const fs::path state = folder_ / fmt::format("state {}", memory);
    const auto keep = [&](SessionRunner& runner) {
      runner.keep_sessions(state, [](const std::string& line) { ADD_FAILURE() << line; });
    };
    auto first = std::make_unique<SessionRunner>();
    keep(*first);
    Configuration c = long_scan();
    c.history.memory = memory;
    first->load(c, job_control());
    for (int k = 0; k < 3; ++k) first->step(job_control());
    PlanningConfig planning = planning_of(first->configuration());
    planning.planner.gain = "rear-side-voxel";
    planning.views.count = 9;
    first->go_to("", 1, job_control());
    first->begin_branch("by rear side");
    first->set_planning(planning, job_control());
    for (int k = 0; k < 2; ++k) first->step(job_control());
    const auto aside = first->snapshot();
    first->go_to("main", 2, job_control());
    const auto main = first->snapshot();
    const fs::path folder = kept_folder(state);
    first.reset();

    SessionRunner second;
    keep(second);
    second.open(folder, job_control());
    expect_same_scan(*second.snapshot(), *main);
    const Timeline& timeline = *second.snapshot()->timeline;
    EXPECT_EQ(timeline.branches, main->timeline->branches);
    ASSERT_EQ(timeline.steps.size(), main->timeline->steps.size());
    for (std::size_t k = 0; k < timeline.steps.size(); ++k) {
      const TimelineStep &was = main->timeline->steps[k], &is = timeline.steps[k];
      EXPECT_EQ(is.after, was.after);
      ASSERT_TRUE(is.record && is.picture) << "it is known before one goes there";
      EXPECT_EQ(is.record->coverage, was.record->coverage);
      EXPECT_EQ(is.record->total_entropy, was.record->total_entropy);
      EXPECT_EQ(is.record->view, was.record->view);
    }
    second.go_to("by rear side", {}, job_control());
    expect_same_scan(*second.snapshot(), *aside);
    second.compare("main", job_control());
    EXPECT_EQ(second.snapshot()->compared->snapshot->records.size(), 3u) << "up to its end";
  }
}

TEST_F(KeptBranches, ACancelledWayThereLeavesAllAsItWas) {
  const fs::path state = folder_ / "state";
  fs::path folder;
  {
    SessionRunner first;
    first.keep_sessions(state, {});
    first.load(long_scan(), job_control());
    for (int k = 0; k < 4; ++k) first.step(job_control());
    first.go_to("", 1, job_control());
    first.step(job_control());
    folder = kept_folder(state);
  }
  runner_.keep_sessions(state, {});
  runner_.open(folder, job_control());
  const auto before = runner_.snapshot();
  for (const double from : {0.0, 0.4, 0.8}) {
    std::stop_source stop;
    SessionRunner::JobControl stopping = job_control();
    stopping.stop = stop.get_token();
    stopping.progress = [&](double fraction, std::string_view) {
      if (fraction >= from) stop.request_stop();
    };
    EXPECT_ANY_THROW(runner_.go_to("main", {}, stopping)) << from;
    EXPECT_EQ(runner_.snapshot(), before);
  }
  steps(1);
  EXPECT_EQ(now().records.size(), before->records.size() + 1);
  runner_.go_to("main", {}, job_control());
  expect_same_scan(now(), *fresh(4, long_scan()));
  fs::remove(folder / "scans/0003.npy");
  SessionRunner third;
  third.keep_sessions(state, {});
  third.open(folder, job_control());
  EXPECT_THROW(third.go_to("main", 3, job_control()), std::runtime_error) << "its capture is gone";
}

TEST_F(KeptBranches, TheSessionThatIsOpenIsNotOpenedAgain) {
  runner_.keep_sessions(folder_ / "state", {});
  runner_.load(small_scan(), job_control());
  steps(1);
  const fs::path own = kept_folder(folder_ / "state");
  try {
    runner_.open(own, job_control());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("is the session that is open"));
  }
}

TEST_F(KeptBranches, ABranchKeepsThePlannerThatWasSetAtItsEnd) {
  const fs::path state = folder_ / "state";
  {
    SessionRunner first;
    first.keep_sessions(state, {});
    first.load(long_scan(), job_control());
    first.step(job_control());
    first.begin_branch("other");
    first.step(job_control());
    PlanningConfig planning = planning_of(first.configuration());
    planning.planner.gain = "rear-side-voxel";
    first.set_planning(planning, job_control());
    first.go_to("main", {}, job_control());
    EXPECT_EQ(first.configuration().planner.gain, long_scan().planner.gain);
  }
  runner_.keep_sessions(state, {});
  runner_.open(kept_folder(state), job_control());
  runner_.go_to("other", {}, job_control());
  EXPECT_EQ(runner_.configuration().planner.gain, "rear-side-voxel");
}

TEST_F(KeptBranches, AScanOfAnEarlierVersionGoesOnInAFolderOfItsOwn) {
  runner_.load(long_scan(), job_control());
  steps(2);
  runner_.write(folder_ / "old", job_control());
  fs::remove(folder_ / "old/journal");
  fs::remove_all(folder_ / "old/scans");
  SessionRunner second;
  second.keep_sessions(folder_ / "state", {});
  second.open(folder_ / "old", job_control());
  EXPECT_EQ(second.snapshot()->records.size(), 2u);
  second.step(job_control());
  expect_same_scan(*second.snapshot(), *fresh(3, long_scan()));
  EXPECT_EQ(read_journal(kept_folder(folder_ / "state")).line().size(), 3u);
}

TEST_F(KeptBranches, WhatIsShownOnlyIsExportedWhole) {
  const fs::path state = folder_ / "state";
  runner_.keep_sessions(state, {});
  runner_.load(long_scan(), job_control());
  steps(3);
  SessionRunner second;
  second.open(kept_folder(state), job_control());  // while the first one writes it
  second.step(job_control());
  second.write(folder_ / "out", job_control());
  SessionRunner third;
  third.open(folder_ / "out", job_control());
  expect_same_scan(*third.snapshot(), *fresh(4, long_scan()));
}

}  // namespace
}  // namespace nextview

// The window's sessions are kept as they go on, wherever one goes in them.
#include "ui/workbench/kept_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <random>

#include "core/file/atomic_file.hpp"
#include "tests/unit/workbench/kept_session_test.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(KeptSessionTest, IsThereFromTheFirstViewOn) {
  auto first = runner();
  first->load(small_scan(), job_control());
  EXPECT_TRUE(kept().empty()) << "nothing has been scanned";
  steps(*first, 3);
  first->undo(job_control());
  ASSERT_EQ(kept().size(), 1u);
  const auto was = first->snapshot();
  first.reset();
  auto second = runner();
  second->open(kept().front(), job_control());
  expect_same_scan(*was, *second->snapshot());
  EXPECT_THAT(notices_, testing::IsEmpty());
}

TEST_F(KeptSessionTest, UndoEndsWhereASessionWasOpenedAndTheTimelineGoesOn) {
  auto first = runner();
  first->load(small_scan(), job_control());
  steps(*first, 3);
  first.reset();
  auto second = runner();
  const fs::path folder = kept().front();
  second->open(folder, job_control());
  EXPECT_FALSE(second->snapshot()->can_undo);
  second->go_to("", 2, job_control());
  second->go_to("", 1, job_control());
  second->undo(job_control());
  EXPECT_EQ(second->snapshot()->records.size(), 3u) << "going along is one change, also the first";
  EXPECT_FALSE(second->snapshot()->can_undo);
  steps(*second, 1);
  for (int k = 0; k < 3; ++k) second->undo(job_control());
  EXPECT_EQ(second->snapshot()->records.size(), 3u) << "what it came with stays";
  EXPECT_EQ(read_journal(folder).line().size(), 3u);
  second->go_to("", 1, job_control());
  EXPECT_EQ(second->snapshot()->records.size(), 1u);
  second->undo(job_control());
  EXPECT_EQ(second->snapshot()->records.size(), 3u);
  second->load(small_scan(), job_control());
  steps(*second, 1);
  second.reset();
  second = runner();
  second->load(small_scan(), job_control());
  steps(*second, 1);
  second->open(folder, job_control());
  second->undo(job_control());
  EXPECT_EQ(second->snapshot()->records.size(), 1u) << "of the session that was left for it";
}

TEST_F(KeptSessionTest, ASecondProgramShowsItAndSaysThatNothingIsKept) {
  auto first = runner(), second = runner();
  first->load(small_scan(), job_control());
  steps(*first, 2);
  second->open(kept().front(), job_control());
  EXPECT_THAT(notices_, testing::ElementsAre(StartsWith(kept().front().string() + ": another program")));
  steps(*second, 1);
  EXPECT_EQ(second->snapshot()->records.size(), 3u);
  EXPECT_TRUE(second->snapshot()->keeping_fails);
  EXPECT_FALSE(first->snapshot()->keeping_fails);
  EXPECT_EQ(first->snapshot()->records.size(), 2u);
  EXPECT_EQ(read_journal(kept().front()).line().size(), 2u);
  EXPECT_EQ(kept().size(), 1u);
}

TEST_F(KeptSessionTest, OneThatWasLeftIsOpenedAgainAndGoneOnWith) {
  auto runner = this->runner();
  runner->load(small_scan(), job_control());
  steps(*runner, 2);
  const fs::path folder = kept().front();
  const auto was = runner->snapshot();
  runner->load(small_scan(), job_control());
  steps(*runner, 1);
  runner->open(folder, job_control());
  expect_same_scan(*was, *runner->snapshot());
  EXPECT_THAT(notices_, testing::IsEmpty()) << "no other program writes it";
  steps(*runner, 1);
  EXPECT_EQ(read_journal(folder).line().size(), 3u);
  runner->undo(job_control());
  runner->undo(job_control());
  EXPECT_EQ(runner->snapshot()->records.size(), 1u) << "the session that was left for it";
}

TEST_F(KeptSessionTest, WhatIsExportedIsASession) {
  auto first = runner();
  first->load(small_scan(), job_control());
  steps(*first, 2);
  first->write(folder_ / "out", job_control());
  EXPECT_THROW(first->write(folder_ / "out", job_control()), std::invalid_argument) << "it is not replaced";
  auto second = runner();
  second->open(folder_ / "out", job_control());
  expect_same_scan(*first->snapshot(), *second->snapshot());
  steps(*second, 1);
  EXPECT_EQ(read_journal(folder_ / "out").line().size(), 3u) << "it goes on where it is";
  second->write(folder_ / "out", job_control());
  EXPECT_TRUE(fs::exists(folder_ / "out/map.ot")) << "one's own folder can be written anew";
  EXPECT_EQ(read_journal(folder_ / "out").line().size(), 3u);
}

// What is put off when a session is opened (what candidates see, then a piece a view) is done while nothing is asked
// for, as far as there is room.
TEST_F(KeptSessionTest, GoingBackInAnOpenedSessionMakesNoMapsAgain) {
  for (const double memory : {1.0, 0.0}) {
    Configuration c = small_scan();
    c.history.memory = memory;
    auto first = runner();
    first->load(c, job_control());
    steps(*first, 2);
    const auto earlier = first->snapshot();
    steps(*first, 1);
    const fs::path folder = kept().back();
    first.reset();
    ASSERT_TRUE(fs::exists(folder / "state"));
    auto second = runner();
    second->open(folder, job_control());
    int pieces = 0;
    while (second->catch_up({})) ++pieces;
    EXPECT_FALSE(second->is_behind());
    EXPECT_EQ(pieces, memory > 0 ? 3 : 1);
    int reports = 0;
    const auto count = [&](double, std::string_view) { ++reports; };
    second->go_to("", 2, {count, [](const SamplerDiagnostics&) {}, {}});
    EXPECT_EQ(reports == 0, memory > 0);
    expect_same_scan(*second->snapshot(), *earlier);
    second.reset();
    fs::remove_all(folder);
  }
}

TEST_F(KeptSessionTest, AnotherPlannerShowsAllThatIsIts) {
  auto first = runner();
  Configuration c = small_scan();
  first->load(c, job_control());
  steps(*first, 2);
  const auto before = first->snapshot();
  PlanningConfig planning = planning_of(first->configuration());
  planning.planner.gain = "rear-side-voxel";
  first->set_planning(planning, job_control());
  const auto after = first->snapshot();
  EXPECT_EQ(after->session, before->session);
  EXPECT_NE(after->gain_unit, before->gain_unit);
  EXPECT_EQ(after->setup->configuration.planner.gain, "rear-side-voxel");
  first->undo(job_control());
  EXPECT_EQ(first->snapshot()->gain_unit, before->gain_unit);
  expect_same_scan(*first->snapshot(), *before);
  first->redo(job_control());
  expect_same_scan(*first->snapshot(), *after);
}

TEST_F(KeptSessionTest, WhereNothingCanBeWrittenItSaysSoOnceAndGoesOn) {
  fs::create_directories(folder_ / "");
  std::ofstream(state()) << "a file in its place";
  auto first = runner();
  first->load(small_scan(), job_control());
  steps(*first, 2);
  EXPECT_EQ(first->snapshot()->records.size(), 2u);
  EXPECT_THAT(notices_, testing::ElementsAre(HasSubstr("goes on in memory")));
}

/// No file may grow beyond a limit: wherever that is met first, it is said once, the scan goes on, and is whole when
/// it is exported to where there is room.
TEST_F(KeptSessionTest, WhereTheDiskIsFullAtAnyWriteItGoesOnInMemory) {
  Configuration c = small_scan();
  const auto whole = runner();
  whole->load(c, job_control());
  steps(*whole, 2);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  int said = 0;
  for (const rlim_t room : {0, 10, 500, 5000, 9000, 12000, 14000, 16000, 18000, 19000, 19500, 25000}) {
    SCOPED_TRACE(room);
    fs::remove_all(state());
    notices_.clear();
    auto first = runner();
    first->load(c, job_control());
    const rlimit full{room, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    steps(*first, 2);
    first->undo(job_control());
    first->redo(job_control());
    first->begin_branch("aside");
    first->go_to("main", {}, job_control());
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_LE(notices_.size(), 1u);
    said += int(notices_.size());
    expect_same_scan(*whole->snapshot(), *first->snapshot());
    fs::remove_all(folder_ / "elsewhere");
    first->write(folder_ / "elsewhere", job_control());
    EXPECT_TRUE(fs::exists(folder_ / "elsewhere/map.ot"));
  }
  EXPECT_GT(said, 6);
}

/// A session that was opened gives the next object no lengths that were only its own object's.
TEST_F(KeptSessionTest, WhatIsOpenedAfterItHasLengthsOfItsOwn) {
  Configuration c = small_scan();
  c.evaluation.enabled = false;
  c.map = {}, c.views = {};
  auto first = runner();
  first->load(c, job_control());
  steps(*first, 1);
  const fs::path folder = kept().front(), small = folder_ / "small.obj";
  write_file(small, "v 0 0 0\nv 120 0 0\nv 0 80 0\nv 0 0 40\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  first->open(small, job_control());
  const std::string expected = to_toml(first->snapshot()->configuration);
  EXPECT_EQ(first->snapshot()->configuration.map.resolution, 0.002);
  first.reset();
  const auto second = runner();
  second->open(folder, job_control());
  EXPECT_EQ(second->snapshot()->records.size(), 1u);
  second->open(small, job_control());
  EXPECT_EQ(to_toml(second->snapshot()->configuration), expected);
}

/// Against the plain meaning of each command: a list of what was done that led here.
TEST_F(KeptSessionTest, CommandsAtRandomAreAllThereWhenItIsOpenedAgain) {
  std::mt19937 random(3);
  auto runner_now = runner();
  Configuration c = small_scan();
  c.evaluation.enabled = false;
  c.termination.views = 50;
  runner_now->load(c, job_control());
  steps(*runner_now, 1);
  const fs::path folder = kept().front();
  for (int k = 0; k < 60; ++k) {
    switch (random() % 7) {
      case 0:
      case 1:
      case 2:
        if (runner_now->can_step()) steps(*runner_now, 1);
        break;
      case 3:
        if (runner_now->snapshot()->records.size() > 1) runner_now->undo(job_control());
        break;
      case 4:
        runner_now->redo(job_control());
        break;
      case 5: {
        PlanningConfig planning = planning_of(runner_now->configuration());
        planning.planner.gain = random() % 2 ? "rear-side-voxel" : "new-surface";
        runner_now->set_planning(planning, job_control());
        break;
      }
      default: {
        const auto was = runner_now->snapshot();
        runner_now.reset();
        runner_now = runner();
        runner_now->open(folder, job_control());
        expect_same_scan(*was, *runner_now->snapshot());
        EXPECT_EQ(runner_now->configuration().planner.gain, was->configuration.planner.gain);
      }
    }
  }
  EXPECT_THAT(notices_, testing::IsEmpty());
  EXPECT_GT(runner_now->snapshot()->records.size(), 1u);
}

}  // namespace
}  // namespace nextview

// The worker's queue: what waits behind a job that is held, what is dropped and when.
#include <gmock/gmock.h>

#include <filesystem>

#include "tests/unit/workbench/gated_worker.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

class WorkerQueue : public GatedWorker {};

TEST_F(WorkerQueue, CancelEmptiesIt) {
  const auto folder = std::filesystem::temp_directory_path() / "nextview-never-written";
  std::filesystem::remove_all(folder);
  load();
  begin_step();
  for (int i = 0; i < 3; ++i) worker_.post(request::Step{});
  worker_.post(request::Refine{1, 8});
  worker_.post(request::Export{folder});
  EXPECT_EQ(worker_.progress().waiting, 5u);
  worker_.cancel();
  EXPECT_EQ(worker_.progress().waiting, 0u);
  EXPECT_TRUE(worker_.progress().busy) << "what runs has not ended yet";
  EXPECT_TRUE(worker_.progress().cancelling);
  open_gate();
  wait_until_idle();
  EXPECT_FALSE(worker_.progress().cancelling);
  EXPECT_TRUE(now()->records.empty());
  EXPECT_EQ(now()->gibbs, nullptr);
  EXPECT_EQ(std::filesystem::remove_all(folder), 0u) << "it was written";
  EXPECT_EQ(now()->message, "");
  EXPECT_THAT(log(), ElementsAre(StartsWith("sphere: "))) << "what was dropped was done";
  step();
  EXPECT_EQ(now()->records.size(), 1u) << "what comes after a cancel is done";
}

/// A script that is saved would do it.
TEST_F(WorkerQueue, WhatIsDroppedIsToldAsNotDone) {
  load();
  worker_.take_done();
  begin_step();
  const std::uint64_t running = worker_.posted();
  worker_.post(request::Step{});
  worker_.post(request::Refine{1, 8});
  worker_.cancel();
  open_gate();
  wait_until_idle();
  std::vector<std::uint64_t> not_done;
  for (const auto& [request, failed] : worker_.take_done())
    if (failed) not_done.push_back(request);
  EXPECT_THAT(not_done, testing::UnorderedElementsAre(running, running + 1, running + 2));
}

TEST_F(WorkerQueue, ALoadEmptiesItAndStopsWhatRuns) {
  Configuration box = small_scan();
  box.object.file = "box";
  load();
  begin_step();
  for (int i = 0; i < 3; ++i) worker_.post(request::Step{});
  worker_.post(request::Load{box});
  EXPECT_EQ(worker_.progress().waiting, 1u);
  open_gate();
  wait_until_idle();
  EXPECT_THAT(log(), ElementsAre(StartsWith("sphere: "), StartsWith("box: "))) << "a view was taken before it";
  EXPECT_EQ(now()->earlier_runs, nullptr);
}

TEST_F(WorkerQueue, WhatWaitsIsDoneInItsOrder) {
  load();
  begin_step();
  worker_.post(request::TakeCustomView{look_at(Vector3(0.31, -0.62, 0.47), Vector3(0.02, 0.01, -0.03))});
  worker_.post(request::Step{});
  worker_.post(request::Undo{});
  worker_.post(request::Step{});
  EXPECT_EQ(worker_.progress().waiting, 4u);
  open_gate();
  wait_until_idle();
  EXPECT_THAT(log(),
              ElementsAre(StartsWith("sphere: "), StartsWith("View 1 from the start view"),
                          StartsWith("View 2 from your custom view"), "Back at view 1",
                          "This begins 'branch 2'; 'main' keeps its 2 views", StartsWith("View 2 from candidate ")));
}

TEST_F(WorkerQueue, OfSettingsThatAreChangedMeanwhileNoneIsLost) {
  load();
  begin_step();
  worker_.post(request::ChangeSetting{"termination.views", "7"});
  worker_.post(request::ChangeSetting{"termination.surface_left", "0.01"});
  worker_.post(request::ChangeSetting{"planner.gain", "farthest"});
  worker_.post(request::ChangeSetting{"planner.cost_weight", "0.5"});
  open_gate();
  wait_until_idle();
  EXPECT_EQ(now()->message, "");
  EXPECT_EQ(now()->records.size(), 1u);
  const Configuration& c = now()->configuration;
  EXPECT_EQ(c.termination.views, 7);
  EXPECT_EQ(c.termination.surface_left, 0.01);
  EXPECT_EQ(c.planner.gain, "farthest");
  EXPECT_EQ(c.planner.weights.cost, 0.5);
}

TEST_F(WorkerQueue, PauseTakesWaitingPlaysAwayAndNothingElse) {
  load();
  begin_step();
  worker_.post(request::Play{});
  worker_.post(request::Step{});
  worker_.post(request::Pause{});
  EXPECT_EQ(worker_.progress().waiting, 1u);
  open_gate();
  wait_until_idle();
  EXPECT_EQ(now()->records.size(), 2u);
  EXPECT_FALSE(worker_.progress().playing);
}

TEST_F(WorkerQueue, CancelEndsPlaying) {
  load();
  close_gate("taking the view");
  worker_.post(request::Play{});
  wait_at_gate();
  EXPECT_TRUE(worker_.progress().playing);
  worker_.cancel();
  open_gate();
  wait_until_idle();
  EXPECT_FALSE(worker_.progress().playing);
  EXPECT_TRUE(now()->records.empty());
}

TEST_F(WorkerQueue, TellsWhatRunsAndForgetsItAfterwards) {
  load();
  worker_.pause_refinement(true);
  EXPECT_FALSE(worker_.progress().paused) << "there is nothing to pause";
  begin_step();
  EXPECT_EQ(worker_.progress().what, "taking the view");
  EXPECT_FALSE(worker_.progress().refining);
  open_gate();
  wait_until_idle();
  const WorkerProgress rest = worker_.progress();
  EXPECT_EQ(rest, WorkerProgress{}) << "something of the last job is left";
  worker_.set_pause_between_views(1.5);
  EXPECT_EQ(worker_.progress().pause_between_views, 1.5);
  worker_.set_pause_between_views(-1);
  EXPECT_EQ(worker_.progress().pause_between_views, 0);
}

/// A refinement that is held, and then cancelled: it ends, the map keeps its sweeps, and the log says so in words.
TEST_F(WorkerQueue, ARefinementIsHeldAndCancelled) {
  load();
  step();
  close_gate("refining the map");
  worker_.post(request::Refine{2, 100'000});
  wait_at_gate();
  EXPECT_TRUE(worker_.progress().refining);
  EXPECT_NE(worker_.progress().sampler, nullptr);
  worker_.pause_refinement(true);
  EXPECT_TRUE(worker_.progress().paused);
  worker_.post(request::Step{});
  open_gate();
  EXPECT_TRUE(worker_.progress().busy);
  worker_.cancel();
  wait_until_idle();
  EXPECT_EQ(worker_.progress(), WorkerProgress{});
  EXPECT_EQ(now()->records.size(), 1u);
  EXPECT_EQ(now()->gibbs, nullptr) << "nothing was sampled yet";
  EXPECT_EQ(last_entry().text, "The refinement is cancelled: there is no Gibbs map yet");
  EXPECT_EQ(last_entry().level, LogEntry::Level::note) << "it is what was asked for";
}

TEST_F(WorkerQueue, ARefinementThatGoesOnEndsByItself) {
  load();
  step();
  close_gate("refining the map");
  worker_.post(request::Refine{2, 12});
  wait_at_gate();
  worker_.pause_refinement(true);
  open_gate();
  worker_.pause_refinement(false);
  wait_until_idle();
  ASSERT_NE(now()->gibbs, nullptr);
  EXPECT_EQ(now()->gibbs->posterior->diagnostics.sweeps, 12);
  EXPECT_THAT(last_entry().text, StartsWith("Gibbs map of 1 view"));
}

}  // namespace
}  // namespace nextview

// What ends a scan changes while it goes on, and the scan is kept.
#include <gmock/gmock.h>

#include "core/progress/stopped.hpp"
#include "tests/unit/workbench/session_runner_test.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/script.hpp"

namespace nextview {
namespace {

Configuration with_views(int views) {
  Configuration c = small_scan();
  c.termination.views = views;
  return c;
}

using TerminationChange = SessionRunnerTest;

TEST_F(TerminationChange, AFinishedScanGoesOn) {
  runner_.load(with_views(3), job_control());
  steps(3);
  ASSERT_FALSE(now().finished.empty());
  const std::uint64_t session = now().session;
  runner_.set_termination(with_views(5).termination);
  EXPECT_EQ(now().session, session) << "the scan is another one";
  EXPECT_EQ(now().records.size(), 3u);
  EXPECT_EQ(now().finished, "");
  EXPECT_EQ(now().configuration.termination.views, 5);
  EXPECT_NE(now().explanation, nullptr) << "the next view is not explained";
  steps(1);
  expect_same_scan(now(), *fresh(4, with_views(5)));
  steps(2);
  expect_same_scan(now(), *fresh(5, with_views(5)));
}

TEST_F(TerminationChange, AScanEndsAtOnceIfItHasEnough) {
  runner_.load(with_views(5), job_control());
  steps(3);
  runner_.set_termination(with_views(2).termination);
  EXPECT_EQ(now().records.size(), 3u);
  EXPECT_EQ(now().finished, "3 views taken");
  const auto finished = runner_.snapshot();
  steps(1);
  EXPECT_EQ(runner_.snapshot(), finished);
  EXPECT_THROW(runner_.set_termination(TerminationConfig{.views = 0}), std::invalid_argument);
  EXPECT_EQ(runner_.snapshot(), finished);
}

TEST_F(TerminationChange, IsUndoneAndRedone) {
  runner_.load(with_views(3), job_control());
  steps(3);
  const auto before = runner_.snapshot();
  runner_.set_termination(with_views(6).termination);
  steps(2);
  const auto all = runner_.snapshot();
  runner_.set_termination(with_views(4).termination);
  EXPECT_FALSE(now().finished.empty());
  runner_.undo(job_control());
  expect_same_scan(now(), *all);
  for (int i = 0; i < 3; ++i) runner_.undo(job_control());
  expect_same_scan(now(), *before);
  EXPECT_EQ(now().session, before->session);
  runner_.undo(job_control());
  expect_same_scan(now(), *fresh(2, with_views(3)));
  for (int i = 0; i < 5; ++i) runner_.redo(job_control());
  EXPECT_EQ(now().finished, "5 views taken") << "the last change is the end of the way";
  EXPECT_FALSE(now().can_redo);
  runner_.undo(job_control());
  expect_same_scan(now(), *all);
}

/// As Continue does, and somebody cancels it.
TEST_F(TerminationChange, IsTakenBackWithAViewThatIsNotTaken) {
  runner_.load(with_views(2), job_control());
  steps(2);
  const auto before = runner_.snapshot();
  runner_.set_termination(with_views(5).termination);
  ASSERT_EQ(now().finished, "");
  std::stop_source cancelled;
  cancelled.request_stop();
  SessionRunner::JobControl control = job_control();
  control.stop = cancelled.get_token();
  try {
    runner_.step(control, {}, true);
  } catch (const Stopped&) {
  }
  expect_same_scan(now(), *before);
  runner_.undo(job_control());
  EXPECT_EQ(now().records.size(), 1u) << "the change is none any more";
}

TEST_F(TerminationChange, NothingToChangeIsFound) {
  runner_.set_termination(with_views(3).termination);
  EXPECT_FALSE(now().loaded());
  EXPECT_FALSE(now().can_undo);
}

/// A worker that does a line of a script at a time, and a load, and is waited for.
struct ScriptedWorker {
  void load(const Configuration& configuration) {
    worker.post(request::Load{configuration});
    wait();
  }
  void run(const char* line) {
    const auto snapshot = worker.snapshot();
    const WorkerProgress progress = worker.progress();
    CommandTarget target{worker, window, *snapshot, progress};
    execute(parse_call(line), target);
    wait();
  }
  void wait() {
    while (worker.progress().busy) std::this_thread::yield();
  }

  SessionWorker worker;
  WindowState window;
};

TEST(ContinueCommand, GoesOnBeyondEveryLimitUntilNoViewIsLeft) {
  ScriptedWorker scripted;
  SessionWorker& worker = scripted.worker;
  Configuration c = with_views(2);
  c.views.count = 5;
  c.termination.coverage = 1e-9;  // and a limit that is met by any view
  scripted.load(c);
  EXPECT_THROW(scripted.run("continue"), std::exception) << "nothing is finished";
  scripted.run("step");
  ASSERT_NE(worker.snapshot()->finished, "");
  const CommandState finished{*worker.snapshot(), {}, scripted.window};
  EXPECT_THAT(find_command("step").why_not_now(finished), testing::EndsWith("; Continue takes more views"));
  scripted.run("continue");
  EXPECT_EQ(worker.snapshot()->finished, "");
  EXPECT_EQ(worker.snapshot()->records.size(), 2u)
      << "it goes on, and nothing starts over; " << worker.snapshot()->message;
  const auto log = *worker.log().entries();
  EXPECT_TRUE(std::ranges::any_of(log, [](const LogEntry& e) {
    return e.text ==
           "The scan goes on for 20 more views at most, however little surface is left; undo brings the limits back";
  }));
  scripted.run("undo");
  EXPECT_EQ(worker.snapshot()->records.size(), 1u) << "the view and the limits are one change";
  EXPECT_NE(worker.snapshot()->finished, "");
  scripted.run("redo");
  EXPECT_EQ(worker.snapshot()->finished, "");
  EXPECT_EQ(worker.snapshot()->records.size(), 2u);
  scripted.run("play");
  EXPECT_EQ(worker.snapshot()->records.size(), 6u) << "the start view and all candidates";
  EXPECT_EQ(worker.snapshot()->finished, "no candidate view is left");
  EXPECT_THROW(scripted.run("continue"), std::exception) << "there is nothing to go on to";
}

/// By Continue alone the planner's view would be taken first, by a robot, too.
TEST(ContinueCommand, IsNotNeededForAViewOfOnesOwn) {
  ScriptedWorker scripted;
  SessionWorker& worker = scripted.worker;
  scripted.load(with_views(1));
  scripted.run("step");
  ASSERT_NE(worker.snapshot()->finished, "");
  scripted.run("take-view 3");
  EXPECT_EQ(worker.snapshot()->finished, "");
  EXPECT_EQ(worker.snapshot()->records.size(), 1u);
  EXPECT_EQ(worker.snapshot()->next_candidate, 3u);
  scripted.run("step");
  EXPECT_EQ(worker.snapshot()->records.back().view, 3);
}

TEST(ContinueCommand, LeavesTheLimitsOfAnotherScanAsTheyWere) {
  ScriptedWorker scripted;
  SessionWorker& worker = scripted.worker;
  scripted.load(with_views(1));
  const TerminationConfig limits = worker.snapshot()->configuration.termination;
  for (const char* another : {"open box", "reset", "set seed 7"}) {
    scripted.run("step");
    ASSERT_NE(worker.snapshot()->finished, "");
    scripted.run("continue");
    scripted.run("step");
    ASSERT_NE(worker.snapshot()->configuration.termination, limits);
    scripted.run(another);
    EXPECT_EQ(worker.snapshot()->records.size(), 0u);
    EXPECT_EQ(worker.snapshot()->configuration.termination, limits) << another;
  }
}

/// As somebody does it who presses + at Views: by the command.
TEST(TerminationCommand, KeepsTheScan) {
  ScriptedWorker scripted;
  SessionWorker& worker = scripted.worker;
  scripted.load(with_views(2));
  scripted.run("step");
  scripted.run("step");
  scripted.run("set termination.views 3");
  EXPECT_EQ(worker.snapshot()->records.size(), 2u);
  EXPECT_EQ(worker.snapshot()->finished, "");
  scripted.run("set termination.views 3");
  scripted.run("set planner.gain occlusion-aware");
  EXPECT_EQ(worker.snapshot()->records.size(), 2u) << "what ranks the views is no part of the scan";
  scripted.run("set gibbs.prior 0.3");
  EXPECT_EQ(worker.snapshot()->records.size(), 2u) << "nor how a map is refined from it";
  EXPECT_EQ(worker.snapshot()->configuration.gibbs.sampler.prior, 0.3);
  scripted.run("set seed 7");
  scripted.run("set seed 7");
  EXPECT_EQ(worker.snapshot()->session, 2u) << "what is so already started the scan over";
  scripted.run("step");
  scripted.run("reset-setting termination.views");
  EXPECT_EQ(worker.snapshot()->records.size(), 1u);
  EXPECT_EQ(worker.snapshot()->configuration.termination.views, 20);
  std::string log;
  for (const LogEntry& entry : *worker.log().entries()) log += entry.text + "\n";
  EXPECT_THAT(log, testing::HasSubstr("The scan goes on"));
  EXPECT_THAT(log, testing::HasSubstr("The candidates are ranked anew; the scan stays"));
  EXPECT_THAT(log, testing::HasSubstr("This setting starts the scan over; undo (Ctrl+Z) brings its 2 views back"));
}

}  // namespace
}  // namespace nextview

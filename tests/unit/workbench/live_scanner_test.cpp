// A live scanner in the window, without the window.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/unit/mesh/temporary_folder.hpp"
#include "ui/workbench/session_worker.hpp"

namespace nextview {
namespace {

class LiveScannerTest : public testing::Test {
 protected:
  LiveScannerTest() { behave("", ""); }

  /// What goes wrong from now on, at a request (tests/unit/driver/fake).
  void behave(const std::string& fault, const std::string& request) const {
    std::ofstream(fault_) << fault << " " << request;
  }
  template <class Predicate>
  void wait_until(Predicate good) {
    std::unique_lock lock(mutex_);
    while (!good()) news_.wait_for(lock, std::chrono::milliseconds(20));
  }
  void wait_until_idle() {
    wait_until([&] { return !worker_.progress().busy; });
  }
  /// A wall, 1 m before the camera.
  void connect() {
    Configuration c;
    c.map.region = "-1 -1 0.5 1 1 1.5";
    c.map.resolution = 0.1;
    c.views.count = 6;
    c.termination.surface_left = 0.0;
    worker_.post(request::Connect{fmt::format("'{}' '{}'", NEXTVIEW_FAKE_DRIVER, fault_.string()), true, c});
    wait_until_idle();
    ASSERT_TRUE(worker_.snapshot()->live) << worker_.snapshot()->message;
  }
  void step(const std::string& answer) {
    worker_.post(request::Step{});
    wait_until([&] { return !worker_.progress().question.empty() || !worker_.progress().busy; });
    worker_.answer(answer);
    wait_until_idle();
  }
  std::size_t views() const { return worker_.snapshot()->records.size(); }

  TemporaryFolder own_;
  std::filesystem::path fault_ = own_ / "fault";
  std::mutex mutex_;
  std::condition_variable news_;
  SessionWorker worker_{[this] { news_.notify_all(); }};
};

TEST_F(LiveScannerTest, MovesWhenTheOperatorAllowsIt) {
  connect();
  EXPECT_EQ(worker_.snapshot()->object_name, "fake");
  step("Refuse");
  EXPECT_EQ(views(), 0u);
  step("Move");
  EXPECT_EQ(views(), 1u);
  EXPECT_TRUE(worker_.progress().question.empty());
}

/// A working volume that is shown but not kept to would be worse than none.
TEST_F(LiveScannerTest, WhatADriverWasStartedWithHoldsUntilItIsConnectedAgain) {
  connect();
  step("Move");
  const auto refused = [&](const std::function<void(Configuration&)>& change) {
    Configuration c = worker_.snapshot()->configuration;
    change(c);
    worker_.post(request::Load{c});
    wait_until_idle();
    EXPECT_EQ(views(), 1u);
    return worker_.snapshot()->message;
  };
  EXPECT_THAT(refused([](Configuration& c) { c.driver.working_volume = "-1 -1 -1 1 1 1"; }),
              testing::HasSubstr("robot.working_volume hold from the next connection on"));
  EXPECT_THAT(refused([](Configuration& c) { c.evaluation.enabled = true; }), testing::HasSubstr("is not known"));
  EXPECT_THAT(refused([](Configuration& c) { c.map.region.clear(); }), testing::HasSubstr("map.region"));
}

TEST_F(LiveScannerTest, ARefusalEndsThePlay) {
  connect();
  worker_.post(request::Play{});
  wait_until([&] { return !worker_.progress().question.empty(); });
  worker_.answer("Refuse");
  wait_until_idle();
  EXPECT_FALSE(worker_.progress().playing);
  EXPECT_EQ(views(), 0u);
}

TEST_F(LiveScannerTest, AnAnswerIsToItsOwnQuestionAlone) {
  connect();
  const auto wait_for_question = [&](std::uint64_t number) {
    wait_until([&] {
      const WorkerProgress now = worker_.progress();
      return !now.question.empty() && now.question_number == number;
    });
  };
  worker_.post(request::Play{});
  wait_for_question(1);
  worker_.answer("Move", 1);
  wait_for_question(2);
  worker_.answer("Move", 1);  // as of a second click
  worker_.answer("Refuse", 2);
  wait_until_idle();
  EXPECT_EQ(views(), 1u);
}

TEST_F(LiveScannerTest, CancellingAnswersTheQuestion) {
  connect();
  worker_.post(request::Step{});
  wait_until([&] { return !worker_.progress().question.empty(); });
  worker_.cancel();
  wait_until_idle();
  EXPECT_EQ(views(), 0u);
}

TEST_F(LiveScannerTest, OneThatIsEndedToStopItIsSaidToBeLost) {
  connect();
  behave("silence", "move");
  worker_.post(request::Step{});
  wait_until([&] { return !worker_.progress().question.empty(); });
  worker_.answer("Move");
  wait_until([&] { return worker_.progress().question.empty(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the request is on its way
  worker_.cancel();
  wait_until_idle();
  EXPECT_TRUE(worker_.snapshot()->scanner_lost);
  EXPECT_THAT(worker_.log().entries()->back().text, testing::HasSubstr("reach it again"));
}

TEST_F(LiveScannerTest, OneThatWasLeftForAnotherIsSaidToBeLostThoughThatWasCancelled) {
  connect();
  behave("silence", "hello");
  worker_.post(request::Connect{fmt::format("'{}' '{}'", NEXTVIEW_FAKE_DRIVER, fault_.string())});
  wait_until([&] { return worker_.progress().what == "reaching the scanner"; });
  worker_.cancel();
  wait_until_idle();
  EXPECT_TRUE(worker_.snapshot()->live) << "the session is another one";
  EXPECT_TRUE(worker_.snapshot()->scanner_lost);
  behave("", "");
  worker_.post(request::Reconnect{});
  wait_until_idle();
  EXPECT_FALSE(worker_.snapshot()->scanner_lost);
}

TEST_F(LiveScannerTest, IsReachedAgainAndGoesOn) {
  connect();
  step("Move");
  behave("die", "move");
  step("Move");
  EXPECT_EQ(views(), 1u) << "what was taken stays";
  EXPECT_TRUE(worker_.snapshot()->scanner_lost);
  EXPECT_THAT(worker_.snapshot()->message, testing::HasSubstr("driver"));
  behave("", "");
  worker_.post(request::Reconnect{});
  wait_until_idle();
  EXPECT_FALSE(worker_.snapshot()->scanner_lost);
  step("Move");
  EXPECT_EQ(views(), 2u);
}

TEST_F(LiveScannerTest, ACaptureOutlivesAFailureAfterIt) {
  connect();
  behave("error", "reach");
  step("Move");
  EXPECT_EQ(views(), 0u);
  behave("", "");
  step("Move");
  EXPECT_EQ(views(), 1u);
}

TEST_F(LiveScannerTest, IsLeftForWhatWasScannedBefore) {
  Configuration box;
  box.object.file = "box";
  box.evaluation.surface_samples = 500;
  box.views.count = 6;
  worker_.post(request::Load{box});
  wait_until_idle();
  connect();
  worker_.post(request::Undo{});
  wait_until_idle();
  EXPECT_FALSE(worker_.snapshot()->live);
  EXPECT_EQ(worker_.snapshot()->object_name, "box");
  worker_.post(request::Redo{});
  wait_until_idle();
  EXPECT_TRUE(worker_.snapshot()->live);
  const std::filesystem::path file = fault_.string() + ".toml";
  std::ofstream(file) << "[object]\nfile = 'box'\n[map]\nregion = ''\n";  // the wall's is not the box's
  worker_.post(request::OpenFile{file});
  wait_until_idle();
  EXPECT_FALSE(worker_.snapshot()->live);
  EXPECT_EQ(worker_.snapshot()->object_name, "box");
  EXPECT_TRUE(worker_.snapshot()->configuration.evaluation.enabled);
  std::filesystem::remove(file);
}

/// What was before the second scanner is not what was before the first.
TEST_F(LiveScannerTest, IsLeftForWhatWasBeforeItAlsoAfterAnotherOneWasUndone) {
  Configuration box;
  box.object.file = "box";
  box.map.region = "-1 -1 -1 1 1 1.5";
  box.map.resolution = 0.1;
  box.views.count = 6;
  box.evaluation.surface_samples = 500;
  const std::string command = fmt::format("'{}' '{}'", NEXTVIEW_FAKE_DRIVER, fault_.string());
  for (const int views : {7, 9}) {
    box.termination.views = views;
    worker_.post(request::Connect{command, true, box});
    wait_until_idle();
    ASSERT_TRUE(worker_.snapshot()->live) << worker_.snapshot()->message;
  }
  worker_.post(request::Undo{});
  wait_until_idle();
  worker_.post(request::Disconnect{});
  wait_until_idle();
  EXPECT_FALSE(worker_.snapshot()->live) << worker_.snapshot()->message;
  EXPECT_EQ(worker_.snapshot()->configuration.termination.views, 7);
}

}  // namespace
}  // namespace nextview

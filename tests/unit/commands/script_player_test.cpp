#include "ui/commands/script_player.hpp"

#include <gmock/gmock.h>

#include "ui/commands/script.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class PlayedScript : public testing::Test {
 protected:
  PlayedScript() {
    player_.set_on_failure(
        [this](const ScriptFailure& f) { told_.push_back(std::to_string(f.line) + " " + f.reason); });
  }
  std::vector<std::string> told() { return std::exchange(told_, {}); }

  SessionSnapshot session_;
  ScriptPlayer player_;
  std::vector<std::string> told_;
};

TEST_F(PlayedScript, WhatIsLeftHasFailedOnceItIsGivenUpAndIsNotDoneAgain) {
  player_.add(parse_script("turn 5 0\nstep\nundo\n"));
  EXPECT_EQ(player_.go_on(session_).front().text(), "turn 5 0");
  player_.give_up("the end");
  EXPECT_THAT(told(), ElementsAre("1 turn: the end", "2 step: the end"));
  EXPECT_TRUE(player_.done());
  EXPECT_THAT(player_.go_on(session_), IsEmpty());
  player_.give_up("again");
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(PlayedScript, WhatRequestsComeToIsTheLastCallsAffair) {
  player_.add(parse_script("step\nundo\n"));
  player_.go_on(session_);
  session_.failures = 1;
  session_.message = "the lens cap is on";
  EXPECT_EQ(player_.go_on(session_).front().text(), "undo");
  EXPECT_THAT(told(), ElementsAre("1 step: the lens cap is on"));
  player_.refused(parse_call("redo"), "not asked for");
  EXPECT_THAT(told(), IsEmpty());
  player_.refused(parse_call("undo"), "there is nothing");
  EXPECT_THAT(told(), ElementsAre("2 undo: there is nothing"));
}

TEST_F(PlayedScript, WhatComesAfterItsEndIsNotItsAffair) {
  player_.add(parse_script("step\n"));
  EXPECT_FALSE(player_.done());
  player_.go_on(session_);
  EXPECT_FALSE(player_.done()) << "what it set going may still fail";
  EXPECT_THAT(player_.go_on(session_), IsEmpty());
  EXPECT_TRUE(player_.done());
  player_.refused(parse_call("step"), "by hand");
  player_.give_up("the end");
  EXPECT_THAT(told(), IsEmpty());
  session_.failures = 1;
  session_.message = "the lens cap is on";
  player_.go_on(session_);
  EXPECT_THAT(told(), ElementsAre("1 the lens cap is on")) << "no command of it was to blame";
  player_.go_on(session_);
  EXPECT_THAT(told(), IsEmpty()) << "it is told once";
}

TEST_F(PlayedScript, AScriptThatQuitsHasFailedAtNothing) {
  player_.add(parse_script("quit\n"));
  player_.go_on(session_);
  player_.give_up("the window is closed");
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(PlayedScript, AScriptThatIsStoppedHasFailedAtNothing) {
  player_.add(parse_script("step\nundo\n"));
  player_.go_on(session_);
  player_.stop();
  EXPECT_TRUE(player_.done());
  player_.give_up("the end");
  player_.refused(parse_call("step"), "by hand");
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_THAT(player_.go_on(session_), IsEmpty());
}

TEST_F(PlayedScript, ARefusalNamesItsCommandOnce) {
  player_.add(parse_script("\nstep\n"));
  player_.go_on(session_);
  player_.refused(parse_call("step"), "step: there is no object yet");
  EXPECT_THAT(told(), ElementsAre("2 step: there is no object yet"));
}

TEST_F(PlayedScript, GoesOnAtRestOrWithWhatCanBeDoneOnlyWhileSomethingRuns) {
  WindowState window;
  WorkerProgress progress;
  const CommandState state{session_, progress, window};
  EXPECT_FALSE(player_.may_go_on(state, true)) << "there is no script";
  player_.add({});
  EXPECT_TRUE(player_.done()) << "nor is nothing one";
  session_.session = 1;
  player_.add(parse_script("step\npause\nstep\n"));
  EXPECT_TRUE(player_.may_go_on(state, true));
  EXPECT_FALSE(player_.may_go_on(state, false));
  player_.go_on(session_);
  EXPECT_FALSE(player_.may_go_on(state, false)) << "nothing is there to be paused";
  progress.playing = progress.busy = true;
  EXPECT_TRUE(player_.may_go_on(state, false));
  player_.go_on(session_);
  EXPECT_FALSE(player_.may_go_on(state, false)) << "a step waits for the end of what runs";
  progress = {};
  EXPECT_TRUE(player_.may_go_on(state, true));
  player_.go_on(session_);
  EXPECT_FALSE(player_.may_go_on(state, false)) << "the last line is not done yet";
  EXPECT_TRUE(player_.may_go_on(state, true));
}

TEST(PlayedScripts, LookNoHigherThanTheZenith) {
  EXPECT_NO_THROW(parse_call("fly-to 0 89 1"));
  EXPECT_THROW(parse_call("fly-to 0 89.5 1"), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

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

TEST(PlayedScripts, LookNoHigherThanTheZenith) {
  EXPECT_NO_THROW(parse_call("fly-to 0 89 1"));
  EXPECT_THROW(parse_call("fly-to 0 89.5 1"), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

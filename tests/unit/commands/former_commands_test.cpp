// Scripts of version 0.4 are read.
#include "ui/commands/former_commands.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "ui/commands/script.hpp"

namespace nextview {
namespace {

TEST(FormerCommands, AreReadAndSaidOnce) {
  ::testing::internal::CaptureStderr();
  for (int time = 0; time < 2; ++time) {
    EXPECT_EQ(parse_call("own-view 0.6 -0.5 0.4 0 0 0").text(), "custom-view 0.6 -0.5 0.4 0 0 0");
    EXPECT_EQ(parse_call("take-own-view").text(), "take-custom-view");
    EXPECT_EQ(parse_call("hold-refinement").text(), "pause-refinement");
    EXPECT_EQ(parse_call("continue-refinement").text(), "resume-refinement");
  }
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 4) << said;
  EXPECT_THAT(said, ::testing::HasSubstr("own-view is called custom-view now"));
}

TEST(FormerCommands, OthersAreAsTheyAre) { EXPECT_EQ(current_command_name("step"), "step"); }

}  // namespace
}  // namespace nextview

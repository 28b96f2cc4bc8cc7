// Ways along the timeline, view by view and branch by branch.
#include <gmock/gmock.h>

#include "tests/unit/commands/worker_commands.hpp"
#include "ui/commands/branch_commands.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class TimelineCommands : public WorkerCommands {
 protected:
  std::string error_of(const std::string& line) {
    try {
      run(line);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  }
  std::size_t views() { return now()->records.size(); }
  std::string branch() { return now()->timeline->branches.current().name; }
};

TEST_F(TimelineCommands, GoAlongTheBranchByAView) {
  EXPECT_EQ(error_of("previous-view"), "previous-view: there is no object yet");
  load();
  EXPECT_EQ(error_of("previous-view"), "previous-view: no view has been taken yet");
  for (int i = 0; i < 3; ++i) step();
  EXPECT_EQ(error_of("next-view"), "next-view: it is the last view of this branch");
  for (const std::size_t before : {2u, 1u, 0u}) {
    run("previous-view");
    EXPECT_EQ(views(), before);
  }
  EXPECT_EQ(error_of("previous-view"), "previous-view: no view has been taken yet");
  for (const std::size_t after : {1u, 2u, 3u}) {
    run("next-view");
    EXPECT_EQ(views(), after);
  }
  EXPECT_EQ(error_of("next-view"), "next-view: it is the last view of this branch");
  run("go-to-view 1");
  EXPECT_EQ(views(), 1u);
}

TEST_F(TimelineCommands, BranchesHaveTheirOwnEnds) {
  load();
  step();
  step();
  EXPECT_THAT(other_branches(*now()), IsEmpty());
  EXPECT_EQ(error_of("go-to-branch main"), "go-to-branch: there is no other branch yet: begin one with branch");
  run("go-to-view 1");
  run("branch mine");
  EXPECT_EQ(branch(), "mine");
  EXPECT_EQ(views(), 1u);
  EXPECT_THAT(other_branches(*now()), ElementsAre("main"));
  EXPECT_EQ(error_of("next-view"), "next-view: it is the last view of this branch") << "main goes on from here";
  run("go-to-branch main");
  EXPECT_EQ(branch(), "main");
  EXPECT_EQ(views(), 2u);
  run("rename-branch mine other");
  EXPECT_THAT(other_branches(*now()), ElementsAre("other"));
  run("go-to-view 1 other");
  EXPECT_EQ(branch(), "other");
  run("remove-branch main");
  EXPECT_THAT(other_branches(*now()), IsEmpty());
}

TEST_F(TimelineCommands, AComparedBranchIsShownUntilItIsNot) {
  load();
  step();
  EXPECT_EQ(error_of("stop-comparing"), "stop-comparing: no branch is compared");
  run("branch mine");
  run("compare main");
  EXPECT_TRUE(now()->compared);
  EXPECT_EQ(window_.in_front(Side::right), panel_name::comparison);
  run("stop-comparing");
  EXPECT_FALSE(now()->compared);
}

}  // namespace
}  // namespace nextview

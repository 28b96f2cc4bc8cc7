// Steps that are gone along, and branches from them, against who only ever did what leads to where one stands.
#include <gmock/gmock.h>

#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {
namespace {

std::vector<std::string> branch_names(const SessionSnapshot& s) {
  std::vector<std::string> names;
  for (const Branch& branch : s.timeline->branches.all) names.push_back(branch.name);
  return names;
}

class SessionBranches : public SessionRunnerTest {
 protected:
  /// On main four views, and from the second on another branch with a view of its own.
  void fork() {
    runner_.load(long_scan(), job_control());
    steps(4);
    runner_.go_to("", 2, job_control());
    runner_.take_view(other());
    steps(1);
  }
  /// A candidate that the planner does not propose.
  std::size_t other() {
    const SessionSnapshot& s = now();
    for (std::size_t k = 0; k < s.candidates.size(); ++k)
      if (s.available(k) && k != s.proposal()) return k;
    ADD_FAILURE();
    return 0;
  }
  std::size_t on() { return now().timeline->branches.on; }
  std::size_t views() { return now().records.size(); }
};

TEST_F(SessionBranches, EachViewCanBeGoneToAndNothingIsCaptured) {
  runner_.load(long_scan(), job_control());
  steps(4);
  const auto all = runner_.snapshot();
  for (const std::size_t views : {2u, 0u, 4u, 1u, 3u}) {
    runner_.go_to("", views, job_control());
    expect_same_scan(now(), *fresh(int(views), long_scan()));
    for (std::size_t k = 0; k < views; ++k) EXPECT_EQ(now().scans[k], all->scans[k]);
    EXPECT_EQ(now().timeline->steps.size(), 4u);
  }
  EXPECT_THROW(runner_.go_to("", 5, job_control()), std::invalid_argument);
  EXPECT_THROW(runner_.go_to("none", 1, job_control()), std::invalid_argument);
  EXPECT_EQ(views(), 3u);
}

TEST_F(SessionBranches, GoingAlongIsOneChange) {
  runner_.load(long_scan(), job_control());
  steps(4);
  for (const std::size_t views : {3u, 2u, 1u, 2u}) runner_.go_to("", views, job_control());
  runner_.undo(job_control());
  EXPECT_EQ(views(), 4u);
  runner_.redo(job_control());
  EXPECT_EQ(views(), 2u);
  runner_.undo(job_control());
  runner_.undo(job_control());
  EXPECT_EQ(views(), 3u) << "before that the last view is undone";
}

TEST_F(SessionBranches, AViewFromTheMiddleBeginsOne) {
  fork();
  EXPECT_THAT(branch_names(now()), testing::ElementsAre("main", "branch 2"));
  EXPECT_EQ(on(), 1u);
  EXPECT_EQ(views(), 3u);
  const auto there = runner_.snapshot();
  EXPECT_EQ(there->timeline->in_common(there->timeline->branches.all[0]), 2u);
  runner_.go_to("main", {}, job_control());
  expect_same_scan(now(), *fresh(4, long_scan()));
  runner_.go_to("branch 2", {}, job_control());
  expect_same_scan(now(), *there);
  steps(1);
  EXPECT_EQ(branch_names(now()).size(), 2u) << "from its end a branch goes on";
}

TEST_F(SessionBranches, UndoGoesBackToTheBranchBeforeAndTheOtherStays) {
  fork();
  const auto forked = runner_.snapshot();
  runner_.undo(job_control());
  EXPECT_EQ(on(), 0u);
  EXPECT_EQ(views(), 2u);
  EXPECT_THAT(branch_names(now()), testing::ElementsAre("main", "branch 2")) << "its view was captured";
  runner_.undo(job_control());
  EXPECT_EQ(views(), 4u);
  runner_.redo(job_control());
  runner_.redo(job_control());
  expect_same_scan(now(), *forked);
  EXPECT_EQ(on(), 1u);
}

TEST_F(SessionBranches, NamedRenamedRemovedAndAllOfItUndone) {
  runner_.load(long_scan(), job_control());
  steps(2);
  runner_.begin_branch("closer");
  EXPECT_EQ(on(), 1u);
  steps(1);
  EXPECT_EQ(now().timeline->line(now().timeline->branches.all[0]).size(), 2u) << "main stays as it was";
  runner_.rename_branch("main", "first");
  EXPECT_THROW(runner_.remove_branch("closer"), std::invalid_argument);
  runner_.remove_branch("first");
  EXPECT_THAT(branch_names(now()), testing::ElementsAre("closer"));
  runner_.undo(job_control());
  EXPECT_THAT(branch_names(now()), testing::ElementsAre("first", "closer"));
  runner_.undo(job_control());
  EXPECT_THAT(branch_names(now()), testing::ElementsAre("main", "closer"));
  runner_.undo(job_control());
  runner_.undo(job_control());
  EXPECT_EQ(views(), 2u);
  EXPECT_EQ(on(), 0u);
  runner_.begin_branch("");
  EXPECT_EQ(now().timeline->branches.current().name, "branch 3");
}

TEST_F(SessionBranches, AreComparedAtTheirEnds) {
  fork();
  const auto here = runner_.snapshot();
  PlanningConfig planning = planning_of(runner_.configuration());
  planning.planner.gain = "rear-side-voxel";
  runner_.set_planning(planning, job_control());
  runner_.compare("main", job_control());
  ASSERT_TRUE(now().compared);
  expect_same_scan(*now().compared->snapshot, *fresh(4, long_scan()));
  EXPECT_EQ(now().configuration.planner.gain, "rear-side-voxel") << "this one stays as it is";
  EXPECT_EQ(views(), here->records.size());
  steps(1);
  ASSERT_TRUE(now().compared) << "and is compared while it goes on";
  runner_.go_to("main", {}, job_control());
  ASSERT_TRUE(now().compared);
  EXPECT_EQ(now().compared->branch, "branch 2") << "the two change places";
  EXPECT_EQ(now().compared->snapshot->configuration.planner.gain, "rear-side-voxel");
  runner_.rename_branch("branch 2", "other");
  ASSERT_TRUE(now().compared);
  EXPECT_EQ(now().compared->branch, "other") << "it goes by its new name";
  runner_.compare("", job_control());
  EXPECT_FALSE(now().compared);
}

TEST_F(SessionBranches, AreComparedViewForView) {
  fork();
  runner_.compare("main", job_control(), true);
  const auto shown = [&] { return now().compared ? now().compared->snapshot->records.size() : 99; };
  EXPECT_EQ(shown(), views());
  steps(1);
  EXPECT_EQ(shown(), std::min<std::size_t>(views(), 4)) << "it has four";
  runner_.go_to("", 1, job_control());
  EXPECT_EQ(shown(), 1u);
  runner_.go_to("", 0, job_control());
  EXPECT_EQ(shown(), 0u);
  runner_.go_to("", {}, job_control());
  expect_same_scan(*now().compared->snapshot, *fresh(int(std::min<std::size_t>(views(), 4)), long_scan()));
  runner_.compare("main", job_control());
  runner_.go_to("", 1, job_control());
  EXPECT_EQ(shown(), 4u) << "its end again";
}

TEST_F(SessionBranches, AViewStaysTakenThoughTheOtherBranchCannotFollowIt) {
  Configuration c = long_scan();
  c.history.memory = 0.0;  // the maps of the other one are to be made again
  runner_.load(c, job_control());
  steps(3);
  runner_.go_to("", 1, job_control());
  runner_.take_view(other());
  steps(1);
  runner_.compare("main", job_control(), true);
  ASSERT_TRUE(now().compared);
  std::stop_source stop;
  SessionRunner::JobControl stopping = job_control();
  stopping.stop = stop.get_token();
  stopping.progress = [&](double, std::string_view what) {
    if (what == "making the map again") stop.request_stop();
  };
  EXPECT_NO_THROW(runner_.step(stopping));
  EXPECT_TRUE(stop.stop_requested()) << "nothing had to be made again";
  EXPECT_EQ(views(), 3u);
  EXPECT_FALSE(now().compared) << "the two have not as many views";
}

TEST_F(SessionBranches, GoingIsUndoneAlsoWhereAsManyChangesWereMadeBefore) {
  runner_.load(long_scan(), job_control());
  steps(5);
  runner_.go_to("", 3, job_control());
  runner_.undo(job_control());
  steps(1);
  runner_.go_to("", 2, job_control());
  runner_.undo(job_control());
  EXPECT_EQ(views(), 6u);
}

TEST_F(SessionBranches, AfterUndoTheRobotStandsWhereItStood) {
  Configuration c = long_scan();
  c.registration.mode = RegistrationConfig::Mode::correct;
  c.registration.beyond_limits = RegistrationConfig::Beyond::accept;  // however a sphere seems to be turned
  c.robot.position_error = 0.004;
  c.sensor.width = 160;
  c.sensor.height = 120;
  runner_.load(c, job_control());
  steps(4);
  const double whole = now().records[3].motion.distance;
  runner_.undo(job_control());
  steps(1);
  EXPECT_EQ(now().records[3].motion.distance, whole);
}

TEST_F(SessionBranches, AChoiceStaysWhereItWasMade) {
  runner_.load(long_scan(), job_control());
  steps(3);
  const std::size_t chosen = other();
  runner_.take_view(chosen);
  runner_.go_to("", 2, job_control());
  EXPECT_EQ(now().next_candidate, now().proposal());
  expect_same_scan(now(), *fresh(2, long_scan()));
  runner_.undo(job_control());
  EXPECT_EQ(views(), 3u);
  EXPECT_EQ(now().next_candidate, chosen) << "undo brings it back";
}

TEST_F(SessionBranches, TheGibbsMapIsThereAgainWhereItsViewsAre) {
  runner_.load(long_scan(), job_control());
  steps(2);
  runner_.refine(2, 8, job_control());
  const auto gibbs = now().gibbs;
  runner_.go_to("", 1, job_control());
  EXPECT_FALSE(now().gibbs);
  runner_.go_to("", 2, job_control());
  EXPECT_EQ(now().gibbs, gibbs);
}

}  // namespace
}  // namespace nextview

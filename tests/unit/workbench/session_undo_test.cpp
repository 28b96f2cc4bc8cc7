#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {
namespace {

TEST_F(SessionRunnerTest, OpeningAnotherObjectForgetsTheAxisOfTheOneBefore) {
  Configuration lying = small_scan();
  lying.object.up = UpAxis::y;
  runner_.load(lying, job_control());
  runner_.open("box", job_control());
  EXPECT_EQ(now().configuration.object.up, UpAxis::automatic);
  runner_.undo(job_control());
  EXPECT_EQ(now().configuration.object.up, UpAxis::y);
}

TEST_F(SessionRunnerTest, NothingWorksOnNothing) {
  EXPECT_FALSE(now().can_undo || now().can_redo || runner_.can_step());
  const auto before = runner_.snapshot();
  runner_.undo(job_control());
  runner_.redo(job_control());
  runner_.step(job_control());
  runner_.take_view(0);
  runner_.take_custom_view(custom_view());
  runner_.refine(1, 4, job_control());
  EXPECT_EQ(runner_.snapshot(), before);
  EXPECT_THROW(runner_.write("/tmp/nextview-no-such-scan", job_control()), std::invalid_argument);
}

TEST_F(SessionRunnerTest, UndoIsAsIfTheStepHadNeverBeen) {
  runner_.load(small_scan(), job_control());
  EXPECT_FALSE(now().can_undo) << "there is nothing before the first session";
  steps(3);
  EXPECT_TRUE(now().can_undo);
  EXPECT_FALSE(now().can_redo);
  for (int left = 2; left >= 0; --left) {
    runner_.undo(job_control());
    EXPECT_TRUE(now().can_redo);
    expect_same_scan(now(), *fresh(left));
  }
  EXPECT_FALSE(now().can_undo);
  const auto first = runner_.snapshot();
  runner_.undo(job_control());
  EXPECT_EQ(runner_.snapshot(), first) << "there was nothing left to undo";
}

TEST_F(SessionRunnerTest, RedoIsTheSameStep) {
  runner_.load(small_scan(), job_control());
  steps(3);
  const auto all = runner_.snapshot();
  for (int i = 0; i < 3; ++i) runner_.undo(job_control());
  for (int i = 0; i < 3; ++i) runner_.redo(job_control());
  EXPECT_FALSE(now().can_redo);
  expect_same_scan(now(), *all);
  EXPECT_EQ(now().session, all->session) << "the scan is the same one";
  steps(1);
  expect_same_scan(now(), *fresh(4));
}

// Also where the maps of then are made again, which begins with those of an earlier view.
TEST_F(SessionRunnerTest, OtherSettingsOfTheGibbsMapAreUndoneAndRedone) {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  c.history.memory = 0.0;
  runner_.load(c, job_control());
  steps(2);
  const auto before = runner_.snapshot();
  PlanningConfig planning = planning_of(now().configuration);
  planning.gibbs.sampler.prior = 0.3;
  runner_.set_planning(planning, job_control());
  const auto changed = runner_.snapshot();
  EXPECT_EQ(changed->session, before->session);
  steps(1);
  const auto after = runner_.snapshot();
  for (int i = 0; i < 2; ++i) runner_.undo(job_control());
  expect_same_scan(now(), *before);
  runner_.redo(job_control());
  expect_same_scan(now(), *changed);
  runner_.redo(job_control());
  expect_same_scan(now(), *after);
  runner_.undo(job_control());
  expect_same_scan(now(), *changed);
}

TEST_F(SessionRunnerTest, AStepOnAnotherWayForgetsTheOldOne) {
  runner_.load(small_scan(), job_control());
  steps(3);
  runner_.undo(job_control());
  steps(1);
  EXPECT_FALSE(now().can_redo);
  expect_same_scan(now(), *fresh(3));
  runner_.undo(job_control());
  runner_.undo(job_control());
  runner_.load(small_scan(), job_control());
  EXPECT_FALSE(now().can_redo);
}

TEST_F(SessionRunnerTest, OverridesAreUndoneAndRedone) {
  runner_.load(small_scan(), job_control());
  steps(1);
  const std::size_t other = now().proposal() == 2 ? 3 : 2;
  runner_.take_view(other);
  EXPECT_EQ(now().next_candidate, other);
  steps(1);
  EXPECT_TRUE(now().records[1].overridden);
  EXPECT_EQ(now().records[1].view, int(other));
  runner_.take_custom_view(custom_view());
  EXPECT_TRUE(now().custom_next_view);
  EXPECT_FALSE(now().next_candidate);
  ASSERT_NE(now().explanation, nullptr);
  const double expected = now().explanation->value;
  steps(1);
  EXPECT_FALSE(now().custom_next_view);
  EXPECT_EQ(now().records[2].view, -1);
  EXPECT_NEAR(now().records[2].gain, expected, 1e-9 * expected);
  EXPECT_TRUE(now().records[2].T_world_camera.isApprox(custom_view(), 1e-12));
  const auto all = runner_.snapshot();
  runner_.undo(job_control());
  EXPECT_TRUE(now().records[1].overridden);
  EXPECT_EQ(now().next_candidate, now().proposal()) << "it is the planner's turn again";
  runner_.undo(job_control());
  expect_same_scan(now(), *fresh(1));
  runner_.redo(job_control());
  runner_.redo(job_control());
  expect_same_scan(now(), *all);
  steps(1);
  EXPECT_FALSE(now().records[3].overridden);
}

TEST_F(SessionRunnerTest, AChoiceIsTakenBackBeforeItsView) {
  runner_.load(small_scan(), job_control());
  steps(1);
  const std::size_t proposal = *now().proposal(), first = proposal == 2 ? 3 : 2, second = proposal == 5 ? 6 : 5;
  runner_.take_view(first);
  runner_.take_view(second);
  runner_.take_view(second);  // once more is no change
  runner_.undo(job_control());
  EXPECT_EQ(now().next_candidate, first);
  runner_.undo(job_control());
  EXPECT_EQ(now().next_candidate, proposal);
  EXPECT_EQ(now().records.size(), 1u);
  runner_.redo(job_control());
  runner_.redo(job_control());
  EXPECT_EQ(now().next_candidate, second);
  runner_.take_custom_view(custom_view());
  runner_.undo(job_control());
  runner_.redo(job_control());
  EXPECT_TRUE(now().custom_next_view);
  steps(1);
  runner_.undo(job_control());
  EXPECT_EQ(now().next_candidate, proposal) << "the view and the choice, in one go";
  runner_.undo(job_control());
  EXPECT_EQ(now().records.size(), 0u);
}

TEST_F(SessionRunnerTest, AnOverrideThatIsNotTakenLeavesNoTrace) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.take_custom_view(custom_view());
  runner_.take_view(*now().proposal());
  EXPECT_FALSE(now().custom_next_view);
  steps(1);
  expect_same_scan(now(), *fresh(3));
  runner_.take_view(*now().proposal());
  runner_.undo(job_control());
  steps(1);
  expect_same_scan(now(), *fresh(3));
}

TEST_F(SessionRunnerTest, UndoGoesBackAcrossObjectsAndSettings) {
  runner_.load(small_scan(), job_control());
  steps(2);
  const auto sphere = runner_.snapshot();
  Configuration other = small_scan();
  other.object.file = "box";
  other.map.resolution = 0.05;
  runner_.load(other, job_control());
  steps(1);
  const auto box = runner_.snapshot();
  EXPECT_GT(box->session, sphere->session);
  runner_.undo(job_control());
  expect_same_scan(now(), *fresh(0, other));
  runner_.undo(job_control());
  expect_same_scan(now(), *sphere);
  EXPECT_NE(now().session, box->session) << "what is selected belongs to another scan";
  runner_.redo(job_control());
  runner_.redo(job_control());
  expect_same_scan(now(), *box);
  EXPECT_FALSE(now().can_redo);
}

TEST_F(SessionRunnerTest, UndoBringsBackWhatWasResetOrFinished) {
  runner_.load(small_scan(), job_control());
  steps(4);
  EXPECT_FALSE(now().finished.empty());
  const auto finished = runner_.snapshot();
  steps(1);
  EXPECT_EQ(runner_.snapshot(), finished) << "a finished scan takes no step";
  runner_.load(runner_.configuration(), job_control());
  EXPECT_TRUE(now().records.empty());
  runner_.undo(job_control());
  expect_same_scan(now(), *finished);
  runner_.undo(job_control());
  EXPECT_TRUE(now().finished.empty());
  steps(1);
  expect_same_scan(now(), *finished);
}

TEST_F(SessionRunnerTest, ALoadThatFailsLeavesAllAsItWas) {
  runner_.load(small_scan(), job_control());
  steps(2);
  runner_.undo(job_control());
  const auto before = runner_.snapshot();
  Configuration bad = small_scan();
  bad.object.file = "/no/such/file.ply";
  EXPECT_ANY_THROW(runner_.load(bad, job_control()));
  EXPECT_EQ(runner_.snapshot(), before);
  runner_.redo(job_control());
  expect_same_scan(now(), *fresh(2));
  EXPECT_ANY_THROW(runner_.take_view(1000));
  EXPECT_ANY_THROW(runner_.take_view(std::size_t(now().records[1].view))) << "it was taken already";
  Pose bent = custom_view();
  bent.linear() *= 2;
  EXPECT_ANY_THROW(runner_.take_custom_view(bent));
  steps(1);
  expect_same_scan(now(), *fresh(3));
}

}  // namespace
}  // namespace nextview

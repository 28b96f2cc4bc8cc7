#include "core/robot/robot.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace nextview {
namespace {

Pose pose_at(const Vector3& position, double turn) {
  return make_pose(position, Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3::UnitY())));
}

MotionCost cost_of(FreeFlyingCamera robot, const Pose& from, const Pose& to) {
  const auto reach = robot.reach(from, std::array{View{to}});
  EXPECT_EQ(reach.size(), 1u);
  EXPECT_EQ(reach[0].unreachable, "");
  return reach[0].cost;
}

/// Why a move failed; of no meaning if it did not.
Failure failure(const Result<Pose>& result) {
  const Failure* const found = std::get_if<Failure>(&result);
  EXPECT_TRUE(found);
  return found ? *found : Failure{};
}

TEST(FreeFlyingCamera, CostIsTheStraightLineAndTheTurn) {
  const FreeFlyingCamera robot(Pose::Identity(), 0.5, 2.0);
  const MotionCost cost = cost_of(robot, pose_at({1, 2, 3}, 0.2), pose_at({1, 5, 7}, 1.0));
  EXPECT_NEAR(cost.distance, 5.0, 1e-12);
  EXPECT_NEAR(cost.rotation, 0.8, 1e-9);
  EXPECT_NEAR(cost.seconds, 10.0, 1e-12);  // 5 m at 0.5 m/s; the turn takes 0.4 s
}

TEST(FreeFlyingCamera, TheSlowerOfMoveAndTurnCounts) {
  const FreeFlyingCamera robot(Pose::Identity(), 1.0, 0.1);
  const MotionCost cost = cost_of(robot, pose_at({0, 0, 0}, 0.0), pose_at({0, 0, 1}, std::numbers::pi / 2));
  EXPECT_NEAR(cost.seconds, std::numbers::pi / 2 / 0.1, 1e-6);
}

TEST(FreeFlyingCamera, GoesAQuarterOfAMetreAndTurnsARadianInASecondUnlessToldOtherwise) {
  const FreeFlyingCamera robot(Pose::Identity());
  EXPECT_NEAR(cost_of(robot, pose_at({0, 0, 0}, 0.0), pose_at({0, 0, 1}, 0.0)).seconds, 4.0, 1e-12);
  EXPECT_NEAR(cost_of(robot, pose_at({0, 0, 0}, 0.0), pose_at({0, 0, 0}, 1.5)).seconds, 1.5, 1e-9);
}

TEST(FreeFlyingCamera, StayingCostsNothing) {
  const FreeFlyingCamera robot(Pose::Identity());
  const Pose pose = pose_at({1, 2, 3}, 0.7);
  const MotionCost cost = cost_of(robot, pose, pose);
  EXPECT_EQ(cost.distance, 0.0);
  EXPECT_NEAR(cost.rotation, 0.0, 1e-7);
  EXPECT_NEAR(cost.seconds, 0.0, 1e-6);
}

TEST(FreeFlyingCamera, StaysInItsVolume) {
  FreeFlyingCamera robot(pose_at({1, 0, 1}, 0.0));
  const View below{pose_at({0.5, 0, -0.1}, 0.0)};
  EXPECT_EQ(robot.reach(robot.pose(), std::array{below})[0].unreachable, "") << "it has none at first";
  robot.keep_within(Eigen::AlignedBox3d(Vector3(-1, -1, 0), Vector3(1, 1, 2)));
  const char* const why = "the camera at (0.5, 0, -0.1) m would leave the working volume (robot.working_volume)";
  EXPECT_EQ(robot.reach(robot.pose(), std::array{below})[0].unreachable, why);
  EXPECT_EQ(failure(robot.move_to(below, {})).reason, why);
  EXPECT_EQ(robot.reach(robot.pose(), std::array{View{pose_at({0.5, 0, 0.1}, 0.0)}})[0].unreachable, "");
}

TEST(FreeFlyingCamera, GoesWhereItIsTold) {
  FreeFlyingCamera robot(pose_at({1, 0, 0}, 0.1));
  EXPECT_EQ(robot.pose().matrix(), pose_at({1, 0, 0}, 0.1).matrix());
  const Pose next = pose_at({100, -3, 5}, 2.0);
  EXPECT_EQ(robot.reach(robot.pose(), std::array{View{next}})[0].unreachable, "");
  EXPECT_EQ(robot.pose().matrix(), pose_at({1, 0, 0}, 0.1).matrix()) << "to ask is not to go";
  const Result<Pose> reached = robot.move_to({next}, {});
  ASSERT_TRUE(std::holds_alternative<Pose>(reached));
  EXPECT_EQ(std::get<Pose>(reached).matrix(), next.matrix());
  EXPECT_EQ(robot.pose().matrix(), next.matrix());
}

TEST(FreeFlyingCamera, StaysWhereItIsIfAPoseCannotBeReached) {
  FreeFlyingCamera robot(pose_at({1, 0, 0}, 0.1));
  const Pose start = robot.pose();
  Pose nowhere = start, twisted = start;
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  twisted.linear()(1, 1) = std::numeric_limits<double>::infinity();
  for (const Pose& bad : {nowhere, twisted}) {
    EXPECT_NE(robot.reach(start, std::array{View{bad}})[0].unreachable, "");
    const Failure why = failure(robot.move_to({bad}, {}));
    EXPECT_EQ(why.kind, Failure::unreachable);
    EXPECT_NE(why.reason, "");
    EXPECT_EQ(robot.pose().matrix(), start.matrix());
  }
}

TEST(FreeFlyingCamera, AnswersForEachViewInTheirOrder) {
  FreeFlyingCamera robot(Pose::Identity());
  Pose nowhere = Pose::Identity();
  nowhere.translation().z() = std::numeric_limits<double>::infinity();
  const std::array views = {View{pose_at({0, 0, 2}, 0)}, View{nowhere}, View{pose_at({0, 0, 5}, 0)}};
  const auto reach = robot.reach(pose_at({0, 0, 1}, 0), views);
  ASSERT_EQ(reach.size(), 3u);
  EXPECT_EQ(reach[0].unreachable, "");
  EXPECT_NE(reach[1].unreachable, "");
  EXPECT_EQ(reach[2].unreachable, "");
  EXPECT_NEAR(reach[0].cost.distance, 1.0, 1e-12) << "from the pose that was asked about, not from where it is";
  EXPECT_NEAR(reach[2].cost.distance, 4.0, 1e-12);
  EXPECT_TRUE(robot.reach(Pose::Identity(), {}).empty());
}

TEST(FreeFlyingCamera, ACancelledMoveLeavesItWhereItWas) {
  FreeFlyingCamera robot(pose_at({1, 0, 0}, 0.1));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(failure(robot.move_to({pose_at({0, 0, 2}, 0)}, stop.get_token())).kind, Failure::cancelled);
  EXPECT_EQ(robot.pose().matrix(), pose_at({1, 0, 0}, 0.1).matrix());
}

TEST(FreeFlyingCamera, GoesBackWithTheScan) {
  FreeFlyingCamera robot(pose_at({1, 0, 0}, 0.1));
  robot.move_to({pose_at({0, 0, 2}, 0)}, {});
  robot.restored(pose_at({1, 0, 0}, 0.1));
  EXPECT_EQ(robot.pose().matrix(), pose_at({1, 0, 0}, 0.1).matrix());
}

TEST(FreeFlyingCamera, SpeedsAreOverZero) {
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(FreeFlyingCamera(Pose::Identity(), bad, 1.0), std::invalid_argument);
    EXPECT_THROW(FreeFlyingCamera(Pose::Identity(), 1.0, bad), std::invalid_argument);
  }
}

}  // namespace
}  // namespace nextview

#include "core/robot/robot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace nextview {
namespace {

Pose pose_at(const Vector3& position, double turn) {
  return make_pose(position, Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3::UnitY())));
}

TEST(FreeFlyingCamera, CostIsTheStraightLineAndTheTurn) {
  const FreeFlyingCamera robot(Pose::Identity(), 0.5, 2.0);
  const MotionCost cost = robot.cost(pose_at({1, 2, 3}, 0.2), pose_at({1, 5, 7}, 1.0));
  EXPECT_NEAR(cost.distance, 5.0, 1e-12);
  EXPECT_NEAR(cost.rotation, 0.8, 1e-9);
  EXPECT_NEAR(cost.seconds, 10.0, 1e-12);  // 5 m at 0.5 m/s; the turn takes 0.4 s
}

TEST(FreeFlyingCamera, TheSlowerOfMoveAndTurnCounts) {
  const FreeFlyingCamera robot(Pose::Identity(), 1.0, 0.1);
  const MotionCost cost = robot.cost(pose_at({0, 0, 0}, 0.0), pose_at({0, 0, 1}, std::numbers::pi / 2));
  EXPECT_NEAR(cost.seconds, std::numbers::pi / 2 / 0.1, 1e-6);
}

TEST(FreeFlyingCamera, StayingCostsNothing) {
  const FreeFlyingCamera robot(Pose::Identity());
  const Pose pose = pose_at({1, 2, 3}, 0.7);
  const MotionCost cost = robot.cost(pose, pose);
  EXPECT_EQ(cost.distance, 0.0);
  EXPECT_NEAR(cost.rotation, 0.0, 1e-7);
  EXPECT_NEAR(cost.seconds, 0.0, 1e-6);
}

TEST(FreeFlyingCamera, GoesWhereItIsTold) {
  FreeFlyingCamera robot(pose_at({1, 0, 0}, 0.1));
  EXPECT_EQ(robot.pose().matrix(), pose_at({1, 0, 0}, 0.1).matrix());
  const Pose next = pose_at({100, -3, 5}, 2.0);
  EXPECT_FALSE(robot.unreachable(next));
  robot.move_to(next);
  EXPECT_EQ(robot.pose().matrix(), next.matrix());
}

TEST(FreeFlyingCamera, StaysWhereItIsIfAPoseCannotBeReached) {
  FreeFlyingCamera robot(pose_at({1, 0, 0}, 0.1));
  const Pose start = robot.pose();
  Pose nowhere = start, twisted = start;
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  twisted.linear()(1, 1) = std::numeric_limits<double>::infinity();
  for (const Pose& bad : {nowhere, twisted}) {
    EXPECT_TRUE(robot.unreachable(bad));
    EXPECT_THROW(robot.move_to(bad), std::runtime_error);
    EXPECT_EQ(robot.pose().matrix(), start.matrix());
  }
}

/// Cannot go below the table.
class AboveTheTable : public FreeFlyingCamera {
 public:
  using FreeFlyingCamera::FreeFlyingCamera;
  std::optional<std::string> unreachable(const Pose& pose) const override {
    if (pose.translation().z() < 0) return "it is below the table";
    return FreeFlyingCamera::unreachable(pose);
  }
};

TEST(FreeFlyingCamera, ADriverThatKnowsLimitsIsHeard) {
  AboveTheTable robot(pose_at({0, 0, 1}, 0));
  try {
    robot.move_to(pose_at({0, 0, -1}, 0));
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("below the table"), std::string::npos) << error.what();
  }
  EXPECT_EQ(robot.pose().translation().z(), 1.0);
  EXPECT_NO_THROW(robot.move_to(pose_at({0, 0, 2}, 0)));
}

}  // namespace
}  // namespace nextview

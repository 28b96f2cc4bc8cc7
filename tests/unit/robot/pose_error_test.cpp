#include "core/robot/pose_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nextview {
namespace {

TEST(PoseError, IsNothingUnlessAskedFor) {
  EXPECT_TRUE(RobotConfig().exact());
  EXPECT_FALSE(RobotConfig({0.001, 0.0}).exact());
  EXPECT_FALSE(RobotConfig({0.0, 0.1}).exact()) << "one error alone is one";
  EXPECT_TRUE(pose_error({}, 7, 3).isApprox(Pose::Identity(), 0.0));
}

TEST(PoseError, HasTheDeviationsThatWereAskedFor) {
  constexpr int count = 4000;
  double squared_shift = 0.0, squared_turn = 0.0;
  Vector3 mean = Vector3::Zero();
  for (std::uint32_t step = 2; step < count + 2; ++step) {
    const Pose error = pose_error({0.005, 1.0}, 1, step);
    ASSERT_TRUE(is_pose(error));
    squared_shift += error.translation().squaredNorm() / count;
    squared_turn += std::pow(rotation_angle(error, Pose::Identity()), 2) / count;
    mean += error.translation() / count;
  }
  EXPECT_NEAR(std::sqrt(squared_shift / 3.0), 0.005, 0.0002) << "along each axis";
  EXPECT_NEAR(std::sqrt(squared_turn) * 180.0 / std::numbers::pi, 1.0, 0.05);
  EXPECT_LT(mean.norm(), 0.0004);
}

TEST(PoseError, DependsOnSeedAndStepAlone) {
  const RobotConfig config{0.005, 1.0};
  EXPECT_EQ(pose_error(config, 1, 2).matrix(), pose_error(config, 1, 2).matrix());
  EXPECT_NE(pose_error(config, 1, 2).matrix(), pose_error(config, 1, 3).matrix());
  EXPECT_NE(pose_error(config, 1, 2).matrix(), pose_error(config, 2, 2).matrix());
}

TEST(PoseError, TheFirstViewSaysWhereTheWorldIs) {
  EXPECT_EQ(pose_error({0.005, 1.0}, 1, 1).matrix(), Pose::Identity().matrix());
}

TEST(PoseError, AnErrorThatIsNotAskedForIsNone) {
  const Pose shifted = pose_error({0.005, 0.0}, 1, 2), turned = pose_error({0.0, 1.0}, 1, 2);
  EXPECT_GT(shifted.translation().norm(), 0.0);
  EXPECT_EQ(shifted.linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(turned.translation(), Vector3::Zero());
  EXPECT_GT(rotation_angle(turned, Pose::Identity()), 0.0);
}

TEST(PoseError, SaysWhichSettingIsOutOfBounds) {
  EXPECT_THROW(RobotConfig({-0.1, 0.0}).validate(), std::invalid_argument);
  EXPECT_THROW(RobotConfig({0.0, 91.0}).validate(), std::invalid_argument);
}

}  // namespace
}  // namespace nextview

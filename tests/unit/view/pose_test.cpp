#include "core/view/pose.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace nextview {
namespace {

Vector3 random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> d(-reach, reach);
  return {d(random), d(random), d(random)};
}

void expect_rotation(const Pose& pose) {
  EXPECT_LT((pose.linear().transpose() * pose.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(pose.linear().determinant(), 1.0, 1e-12);
  EXPECT_EQ(pose.matrix().row(3), Eigen::RowVector4d(0, 0, 0, 1));
}

TEST(LookAt, LooksAlongZWithTheWorldUpright) {
  std::mt19937 random(3);
  for (int n = 0; n < 2000; ++n) {
    const Vector3 position = random_point(random, 2), target = random_point(random, 2);
    const Pose pose = look_at(position, target);
    expect_rotation(pose);
    EXPECT_EQ(pose.translation(), position);
    EXPECT_LT((pose.linear().col(2) - (target - position).normalized()).norm(), 1e-12);
    EXPECT_NEAR(pose.linear().col(0).z(), 0.0, 1e-12);  // the image's rows lie level
    EXPECT_LT(pose.linear().col(1).z(), 0.0);           // y points down
  }
}

TEST(LookAt, StraightUpAndDownTakesTheWorldsYForUp) {
  for (const double z : {1.0, -1.0}) {
    const Pose pose = look_at(Vector3(0.4, 0.1, 0.2), Vector3(0.4, 0.1, 0.2 + z));
    expect_rotation(pose);
    EXPECT_LT((pose.linear().col(2) - Vector3(0, 0, z)).norm(), 1e-12);
    EXPECT_LT((pose.linear().col(1) + Vector3::UnitY()).norm(), 1e-12);  // down in the image is -y
  }
}

TEST(LookAt, NearlyVerticalIsStillARotation) {
  for (const double offset : {1e-3, 1e-6, 1e-8, 1e-10, 1e-13, 1e-16, 1e-300})
    for (const double z : {1.0, -1.0}) {
      const Pose pose = look_at(Vector3(offset, -offset, 0), Vector3(0, 0, z));
      expect_rotation(pose);
      EXPECT_LT((pose.linear().col(2) - Vector3(-offset, offset, z).normalized()).norm(), 1e-9) << offset;
    }
}

TEST(RotationAngle, IsTheAngleOfTheRotationBetweenTwoPoses) {
  std::mt19937 random(4);
  for (const double angle : {0.0, 1e-9, 1e-4, 0.3, 1.5, 3.0, std::numbers::pi - 1e-7, std::numbers::pi}) {
    for (int n = 0; n < 50; ++n) {
      Pose a = Pose::Identity();
      a.linear() = Eigen::AngleAxisd(1.7, random_point(random, 1).normalized()).toRotationMatrix();
      a.translation() = random_point(random, 3);
      Pose b = a * Eigen::AngleAxisd(angle, random_point(random, 1).normalized());
      b.translation() = random_point(random, 3);
      EXPECT_NEAR(rotation_angle(a, b), angle, 1e-7) << angle;
      EXPECT_NEAR(rotation_angle(b, a), angle, 1e-7) << angle;
    }
  }
}

TEST(MakePose, TakesCameraPointsToTheWorld) {
  // A quarter turn about z: camera x becomes world y.
  const Pose pose = make_pose({1, 2, 3}, Eigen::Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5)));
  expect_rotation(pose);
  EXPECT_LT((pose * Vector3(1, 0, 0) - Vector3(1, 3, 3)).norm(), 1e-12);
}

TEST(IsPose, ARotationAndAPlaceAreAndNothingElse) {
  const Pose good = look_at(Vector3(0.3, -2.0, 0.7), Vector3(0.1, 0.0, 0.0));
  EXPECT_TRUE(is_pose(good));
  EXPECT_TRUE(is_pose(Pose::Identity()));
  Pose rounded = good, nan = good, infinite = good, far = good, scaled = good, mirrored = good, sheared = good,
       flat = good;
  rounded.linear() = good.linear().cast<float>().cast<double>();
  nan.linear()(1, 2) = std::nan("");
  infinite.translation().z() = INFINITY;
  far.translation().x() = -1.001 * farthest_pose;
  scaled.linear() *= 1.0001;
  mirrored.linear().row(2) *= -1.0;
  sheared.linear().col(0) += 0.001 * good.linear().col(1);
  flat.linear().col(2).setZero();
  EXPECT_TRUE(is_pose(rounded));
  for (const Pose& bad : {nan, infinite, far, scaled, mirrored, sheared, flat}) EXPECT_FALSE(is_pose(bad));
}

}  // namespace
}  // namespace nextview

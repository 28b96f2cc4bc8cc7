#include <gtest/gtest.h>

#include "core/cloud/point_cloud.hpp"

namespace nextview {
namespace {

DepthImage image_of(int width, int height, float range) {
  DepthImage image;
  image.camera = PinholeCamera::from_field_of_view(width, height, 1.0);
  image.range.assign(std::size_t(width) * height, range);
  return image;
}

Pose tilted_pose() {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(0.7, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  pose.translation() = Vector3(0.3, -0.8, 1.1);
  return pose;
}

TEST(BackProjection, EveryPixelProjectsBackToItselfAtItsRange) {
  DepthImage image = image_of(17, 11, 0.0f);
  for (std::size_t i = 0; i < image.range.size(); ++i) image.range[i] = 0.5f + 0.003f * float(i);
  const Pose T_world_camera = tilted_pose();
  const Scan scan = back_project(image, T_world_camera, 1.5);
  EXPECT_EQ(scan.origin, T_world_camera.translation());
  EXPECT_TRUE(scan.misses.empty());
  ASSERT_EQ(scan.hits.size(), image.range.size());
  for (std::size_t i = 0; i < image.range.size(); ++i) {
    const Vector3 in_camera = T_world_camera.inverse() * scan.hits[i].cast<double>();
    EXPECT_NEAR(in_camera.norm(), image.range[i], 1e-6);  // along the ray, not along z
    ASSERT_GT(in_camera.z(), 0.0);
    const Eigen::Vector2d pixel = image.camera.project(in_camera);
    EXPECT_NEAR(pixel.x(), double(i % 17), 1e-4);
    EXPECT_NEAR(pixel.y(), double(i / 17), 1e-4);
  }
}

TEST(BackProjection, BeyondRangePassesAtMaximumRangeAndInvalidSaysNothing) {
  DepthImage image = image_of(3, 1, DepthImage::invalid);
  image.range[0] = 0.7f;
  image.range[2] = DepthImage::beyond_range;
  const Scan scan = back_project(image, tilted_pose(), 1.25);
  ASSERT_EQ(scan.hits.size(), 1u);
  ASSERT_EQ(scan.misses.size(), 1u);
  EXPECT_NEAR((scan.hits[0].cast<double>() - scan.origin).norm(), 0.7, 1e-6);
  EXPECT_NEAR((scan.misses[0].cast<double>() - scan.origin).norm(), 1.25, 1e-6);
  const Vector3 in_camera = tilted_pose().inverse() * scan.misses[0].cast<double>();
  EXPECT_NEAR(image.camera.project(in_camera).x(), 2.0, 1e-4);
}

}  // namespace
}  // namespace nextview

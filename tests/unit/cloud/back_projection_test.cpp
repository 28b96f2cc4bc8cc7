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

// Rows are done side by side; the order is the image's.
TEST(BackProjection, PointsStandInTheOrderOfPixels) {
  DepthImage image = image_of(23, 19, 0.5f);
  for (std::size_t i = 0; i < image.range.size(); ++i) {
    if (i * i % 7 < 3) image.range[i] = DepthImage::beyond_range;
    if (i * i % 11 < 3) image.range[i] = DepthImage::invalid;
  }
  const Scan scan = back_project(image, tilted_pose(), 1.25);
  std::size_t hits = 0, misses = 0;
  for (std::size_t i = 0; i < image.range.size(); ++i) {
    const Vector3 along = tilted_pose().linear() * image.camera.direction(double(i % 23), double(i / 23));
    if (DepthImage::is_range(image.range[i])) {
      EXPECT_EQ(scan.hits.at(hits++), (scan.origin + 0.5 * along).cast<float>());
    } else if (DepthImage::is_beyond_range(image.range[i])) {
      EXPECT_EQ(scan.misses.at(misses++), (scan.origin + 1.25 * along).cast<float>());
    }
  }
  EXPECT_EQ(scan.hits.size(), hits);
  EXPECT_EQ(scan.misses.size(), misses);
  EXPECT_GT(std::min(hits, misses), 50u);
}

}  // namespace
}  // namespace nextview

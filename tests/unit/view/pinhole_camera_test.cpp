#include "core/view/pinhole_camera.hpp"

#include <gtest/gtest.h>

#include <random>

namespace nextview {
namespace {

TEST(PinholeCamera, PixelsProjectBackToThemselves) {
  PinholeCamera camera;
  camera.fx = 448.1, camera.fy = 391.0, camera.cx = 301.25, camera.cy = 222.0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-50, 690), v(-50, 530), range(0.1, 5);
  for (int n = 0; n < 5000; ++n) {
    const Eigen::Vector2d pixel(u(random), v(random));
    const Vector3 direction = camera.direction(pixel.x(), pixel.y());
    EXPECT_NEAR(direction.norm(), 1.0, 1e-14);
    EXPECT_GT(direction.z(), 0.0);
    EXPECT_LT((camera.project(range(random) * direction) - pixel).norm(), 1e-9);
  }
}

TEST(PinholeCamera, AxesPointRightDownAndForward) {
  const PinholeCamera camera = PinholeCamera::from_field_of_view(640, 480, 1.0);
  EXPECT_GT(camera.project(Vector3(0.1, 0, 1)).x(), camera.cx);
  EXPECT_GT(camera.project(Vector3(0, 0.1, 1)).y(), camera.cy);
  EXPECT_LT((camera.direction(camera.cx, camera.cy) - Vector3::UnitZ()).norm(), 1e-15);
}

// Pixel centres lie at whole numbers, so the image reaches from -1/2 to width - 1/2.
TEST(PinholeCamera, TheFieldOfViewIsThatOfTheWholeImage) {
  for (const double field : {0.05, 0.5, 1.0122909661567112, 2.0, 3.0})
    for (const int width : {1, 2, 80, 641}) {
      const PinholeCamera camera = PinholeCamera::from_field_of_view(width, 60, field);
      EXPECT_EQ(camera.width, width);
      EXPECT_EQ(camera.height, 60);
      EXPECT_EQ(camera.fx, camera.fy);
      EXPECT_NEAR(camera.cy, 29.5, 1e-12);
      const Vector3 left = camera.direction(-0.5, camera.cy), right = camera.direction(width - 0.5, camera.cy);
      EXPECT_NEAR(std::acos(left.dot(right)), field, 1e-9);
      EXPECT_NEAR(left.x(), -right.x(), 1e-12);
    }
}

}  // namespace
}  // namespace nextview

// The camera that stands for a sensor of which only clouds are known.
#include "core/recording/cloud_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nextview {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Points of a grid of rays, at distances that do not matter.
CloudCamera seeing(int columns, int rows, const Eigen::Vector2d& low, const Eigen::Vector2d& high, int frames = 1) {
  CloudCamera seen;
  for (int frame = 0; frame < frames; ++frame) {
    for (int v = 0; v < rows; ++v)
      for (int u = 0; u < columns; ++u) {
        const double z = 0.5 + 0.1 * ((u + 3 * v) % 7);
        seen.see({z * (low.x() + (high.x() - low.x()) * u / (columns - 1)),
                  z * (low.y() + (high.y() - low.y()) * v / (rows - 1)), z});
      }
    seen.end_of_frame();
  }
  return seen;
}

TEST(CloudCamera, TheOutermostRaysGoThroughTheOutermostPixels) {
  const CloudCamera seen = seeing(41, 31, {-0.5, -0.25}, {0.75, 0.5});
  const PinholeCamera camera = seen.camera();
  EXPECT_EQ(seen.outside(), "");
  const Eigen::Vector2d first = camera.project({-0.5, -0.25, 1.0}), last = camera.project({1.5, 1.0, 2.0});
  EXPECT_NEAR(first.norm(), 0.0, 1e-9);
  EXPECT_NEAR(last.x(), camera.width - 1, 1e-9);
  EXPECT_NEAR(last.y(), camera.height - 1, 1e-9);
}

// About as many pixels as points of a frame, as wide as they are high.
TEST(CloudCamera, HasAboutAPixelAPoint) {
  for (const int frames : {1, 4}) {
    const PinholeCamera camera = seeing(81, 41, {-0.8, -0.4}, {0.8, 0.4}, frames).camera();
    EXPECT_NEAR(camera.width, 81, 2) << frames;
    EXPECT_NEAR(camera.height, 41, 2) << frames;
    EXPECT_NEAR(camera.fx / camera.fy, 1.0, 0.02);
  }
}

// Frames that show a disc here and there in the image: neither what is empty of a frame nor where others are counts.
TEST(CloudCamera, PixelsAreAsDenseAsPointsWhereThereAreAny) {
  constexpr double focal_length = 100.0;
  CloudCamera seen;
  for (const Eigen::Vector2d& middle :
       {Eigen::Vector2d(-0.5, -0.3), Eigen::Vector2d(0.4, 0.3), Eigen::Vector2d(0, 0)}) {
    for (int v = -100; v <= 100; ++v)
      for (int u = -100; u <= 100; ++u)
        if (const Eigen::Vector2d at = Eigen::Vector2d(u, v) / focal_length; (at - middle).norm() < 0.2)
          seen.see({at.x(), at.y(), 1.0});
    seen.end_of_frame();
  }
  const PinholeCamera camera = seen.camera();
  EXPECT_NEAR(camera.fx, focal_length, 0.1 * focal_length);
  EXPECT_NEAR(camera.width, 1.3 * focal_length, 0.1 * 1.3 * focal_length) << "as wide as all of them";
}

TEST(CloudCamera, HasAtMost640PixelsASideAndAtLeastTwo) {
  const PinholeCamera large = seeing(1000, 500, {-0.8, -0.4}, {0.8, 0.4}).camera();
  EXPECT_EQ(large.width, 640);
  EXPECT_NEAR(large.height, 320, 2) << "its pixels stay square";
  CloudCamera one;
  one.see({0.2, -0.1, 2.0});
  one.end_of_frame();
  const PinholeCamera small = one.camera();
  EXPECT_GE(std::min(small.width, small.height), 2);
  const Eigen::Vector2d pixel = small.project({0.2, -0.1, 2.0});
  EXPECT_NEAR(pixel.x(), 0.5 * (small.width - 1), 1e-6) << "its only ray is in the middle";
  EXPECT_NEAR(pixel.y(), 0.5 * (small.height - 1), 1e-6);
}

TEST(CloudCamera, RaysBeyond150DegreesOrBehindItAreLeftOutAndCounted) {
  const double inside = std::tan(74.9 * degree), beyond = std::tan(75.1 * degree);
  for (const Vector3& left_out :
       {Vector3(beyond, 0, 1), Vector3(0, -beyond, 1), Vector3(0.1, 0.1, -1), Vector3(1, 0, 0), Vector3(0, 0, 0)}) {
    CloudCamera seen = seeing(3, 1 + 2, {-0.5, -0.5}, {0.5, 0.5});
    seen.see(left_out);
    EXPECT_EQ(seen.outside(), "10.0 % of the rays lie outside the camera of 150 degrees that stands for the sensor")
        << left_out.transpose();
    const PinholeCamera camera = seen.camera();
    EXPECT_NEAR((camera.width - 1) / camera.fx, 1.0, 1e-9) << "as wide as without it";
  }
  for (const Vector3& held : {Vector3(inside, 0, 1), Vector3(0, -inside, 1), Vector3(-2 * inside, 2 * inside, 2)}) {
    CloudCamera seen = seeing(3, 3, {-0.5, -0.5}, {0.5, 0.5});
    seen.see(held);
    EXPECT_EQ(seen.outside(), "") << held.transpose();
  }
}

TEST(CloudCamera, OfWhatIsAllBehindItIsAsWideAsItMayBe) {
  CloudCamera seen;
  seen.see({0, 0, -1});
  seen.end_of_frame();
  const PinholeCamera camera = seen.camera();
  EXPECT_NEAR((camera.width - 1) / camera.fx, 2.0 * std::tan(75.0 * degree), 1e-9);
  EXPECT_NEAR((camera.height - 1) / camera.fy, 2.0 * std::tan(75.0 * degree), 1e-9);
  EXPECT_EQ(seen.outside(), "100.0 % of the rays lie outside the camera of 150 degrees that stands for the sensor");
}

}  // namespace
}  // namespace nextview

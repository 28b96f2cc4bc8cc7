#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/gain/ray.hpp"

namespace nextview {
namespace {

PinholeCamera conformance_camera() {
  PinholeCamera camera;
  camera.width = 752, camera.height = 480;
  camera.fx = camera.fy = 448.10089858533428;
  camera.cx = 376.5, camera.cy = 240.5;
  return camera;
}

// Pixel centres lie at whole numbers: the image is [-1/2, width - 1/2).
TEST(RayBundle, RegularRaysPassThroughTheMiddlesOfEqualCells) {
  const PinholeCamera camera = PinholeCamera::from_field_of_view(640, 480, 1.0);
  const RayBundle bundle = RayBundle::regular(camera);
  ASSERT_EQ(bundle.directions.size(), 950u);
  std::size_t n = 0;
  for (int row = 0; row < 25; ++row)
    for (int column = 0; column < 38; ++column, ++n) {
      EXPECT_NEAR(bundle.directions[n].norm(), 1.0, 1e-12);
      const Eigen::Vector2d pixel = camera.project(bundle.directions[n]);
      EXPECT_NEAR(pixel.x(), (column + 0.5) * 640 / 38 - 0.5, 1e-9);
      EXPECT_NEAR(pixel.y(), (row + 0.5) * 480 / 25 - 0.5, 1e-9);
    }
}

TEST(RayBundle, AWindowIsTheMiddleOfTheImage) {
  const PinholeCamera camera = conformance_camera();
  const RayBundle whole = RayBundle::regular(camera, 38, 25), asked = RayBundle::regular(camera, 38, 25, 1.0);
  EXPECT_EQ(whole.directions, asked.directions);
  const RayBundle half = RayBundle::regular(camera, 38, 25, 0.5);
  ASSERT_EQ(half.directions.size(), 950u);
  const Eigen::Vector2d first = camera.project(half.directions.front()), last = camera.project(half.directions.back());
  EXPECT_NEAR(first.x(), 752 / 4.0 + 0.25 * 752 / 38 - 0.5, 1e-9);
  EXPECT_NEAR(first.y(), 480 / 4.0 + 0.25 * 480 / 25 - 0.5, 1e-9);
  EXPECT_NEAR(first.x() + last.x(), 751, 1e-9);
  EXPECT_NEAR(first.y() + last.y(), 479, 1e-9);
  const RayBundle pixels = RayBundle::regular(camera, 376, 240, 0.5), one = RayBundle::regular(camera, 752, 480);
  EXPECT_NEAR(pixels.solid_angles.front(), one.solid_angles[120 * 752 + 188], 1e-15) << "a pixel each";
}

TEST(RayBundle, AsManyRaysAsPixelsGoThroughPixels) {
  const PinholeCamera camera = PinholeCamera::from_field_of_view(8, 6, 1.0);
  const RayBundle bundle = RayBundle::regular(camera, 8, 6);
  ASSERT_EQ(bundle.directions.size(), 48u);
  EXPECT_LT((bundle.directions[0] - camera.direction(0, 0)).norm(), 1e-12);
  EXPECT_LT((bundle.directions[47] - camera.direction(7, 5)).norm(), 1e-12);
}

TEST(RayBundle, TheReferenceBundleHas950RaysFromWholePixels) {
  const PinholeCamera camera = conformance_camera();
  const RayBundle bundle = RayBundle::reference(camera, {0.25, 0.25}, {0.75, 0.75}, {10, 10});
  ASSERT_EQ(bundle.directions.size(), 38u * 25u);
  std::vector<std::pair<int, int>> pixels;
  for (const Vector3& d : bundle.directions) {
    const Eigen::Vector2d pixel = camera.project(d);
    EXPECT_NEAR(pixel.x(), std::round(pixel.x()), 1e-9);
    EXPECT_NEAR(pixel.y(), std::round(pixel.y()), 1e-9);
    pixels.push_back({int(std::round(pixel.x())), int(std::round(pixel.y()))});
  }
  std::sort(pixels.begin(), pixels.end());
  std::vector<std::pair<int, int>> expected;
  for (int x = 188; x <= 564; x += 10)
    for (int y = 120; y <= 360; y += 10) expected.push_back({x, y});
  EXPECT_EQ(pixels, expected);
}

TEST(RayBundle, ReferencePixelsAreTruncated) {
  PinholeCamera camera = conformance_camera();
  camera.width = 751, camera.height = 9;  // x from 187.75: 187, 190 (190.25), 192 (192.75), ...
  const RayBundle bundle = RayBundle::reference(camera, {0.25, 0.0}, {0.2567, 0.0}, {2.5, 2.5});
  ASSERT_EQ(bundle.directions.size(), 3u);
  const double expected[] = {187, 190, 192};
  for (int n = 0; n < 3; ++n) EXPECT_NEAR(camera.project(bundle.directions[n]).x(), expected[n], 1e-9);
}

/// Of a pyramid whose image is [left, right] x [top, bottom] at distance 1 [sr]: four corners, each atan(x y / r).
double pyramid(double left, double right, double top, double bottom) {
  const auto corner = [](double x, double y) { return std::atan2(x * y, std::sqrt(1.0 + x * x + y * y)); };
  return corner(right, bottom) - corner(left, bottom) - corner(right, top) + corner(left, top);
}

TEST(RayBundle, SolidAnglesAddUpToThatOfTheImage) {
  for (const double field_of_view : {0.2, 1.0, 2.0}) {
    const PinholeCamera camera = PinholeCamera::from_field_of_view(640, 480, field_of_view);
    const double a = field_of_view, b = 2 * std::atan(0.75 * std::tan(0.5 * a));
    const double whole = 4 * std::asin(std::sin(0.5 * a) * std::sin(0.5 * b));
    for (const auto& [columns, rows] : {std::pair(38, 25), std::pair(160, 120)}) {
      const RayBundle bundle = RayBundle::regular(camera, columns, rows);
      ASSERT_EQ(bundle.solid_angles.size(), bundle.directions.size());
      double sum = 0.0;
      for (const double angle : bundle.solid_angles) sum += angle;
      EXPECT_NEAR(sum / whole, 1.0, columns > 100 ? 1e-4 : 1e-3) << field_of_view;
    }
  }
}

// Ray by ray, with a principal point that is not in the middle and pixels that are not square.
TEST(RayBundle, EachSolidAngleIsThatOfItsPart) {
  PinholeCamera camera = conformance_camera();
  camera.fy = 390.0, camera.cx = 300.0;
  const auto across = [&](double u) { return (u - camera.cx) / camera.fx; };
  const auto down = [&](double v) { return (v - camera.cy) / camera.fy; };
  const auto expect = [&](const RayBundle& bundle, double width, double height) {
    ASSERT_EQ(bundle.solid_angles.size(), bundle.directions.size());
    for (std::size_t i = 0; i < bundle.directions.size(); ++i) {
      const Eigen::Vector2d pixel = camera.project(bundle.directions[i]);
      const double expected = pyramid(across(pixel.x() - width / 2), across(pixel.x() + width / 2),
                                      down(pixel.y() - height / 2), down(pixel.y() + height / 2));
      EXPECT_NEAR(bundle.solid_angles[i] / expected, 1.0, 1e-3);
    }
  };
  expect(RayBundle::regular(camera, 47, 30), 16.0, 16.0);
  expect(RayBundle::reference(camera, {0.25, 0.25}, {0.75, 0.75}, {10, 8}), 10.0, 8.0);
}

}  // namespace
}  // namespace nextview

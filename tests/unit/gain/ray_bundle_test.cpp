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

}  // namespace
}  // namespace nextview

// Clouds while something moves: fewer points, larger, that cover about as much.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/render/render_test.hpp"
#include "ui/layers/cloud_layer.hpp"

namespace nextview {
namespace {

/// Points of a ball, evenly.
PointCloud ball(int count) {
  PointCloud points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count, radius = std::sqrt(1 - z * z);
    const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    points.emplace_back(float(radius * std::cos(azimuth)), float(radius * std::sin(azimuth)), float(z));
  }
  return points;
}

Image drawn_ball(int count, bool coarse, bool and_back = false) {
  return draw_scene(320, 240, [&](Scene& scene) {
    scene.cloud().show(ball(count));
    if (and_back) scene.cloud().set_coarse(!coarse);
    scene.cloud().set_coarse(coarse);
    scene.frame();
  });
}

/// Of all pixels, those that a point covers: bluer than the ground is.
double covered(const Image& image) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) count += image.rgba[i + 2] > image.rgba[i] + 24;
  return count / (0.25 * double(image.rgba.size()));
}

TEST(CoarseClouds, CoverAboutAsMuch) {
  const double fine = covered(drawn_ball(20'000, false)), coarse = covered(drawn_ball(20'000, true));
  EXPECT_GT(fine, 0.1);
  EXPECT_NEAR(coarse, fine, 0.1 * fine);
}

TEST(CoarseClouds, AreOtherPicturesAndTheSameOnesAfterwards) {
  const Image fine = drawn_ball(20'000, false);
  EXPECT_NE(fine, drawn_ball(20'000, true));
  EXPECT_EQ(fine, drawn_ball(20'000, false, true));
}

TEST(CoarseClouds, OfFewPointsKeepThemAll) {
  const double few = covered(drawn_ball(900, false));
  EXPECT_GT(few, 0.01);
  EXPECT_GT(covered(drawn_ball(900, true)), few) << "squares cover more than balls";
}

/// A section that comes while one of the two is drawn, and what the other looks like then.
Image cut(bool coarse_before, bool coarse) {
  return draw_scene(320, 240, [&](Scene& scene) {
    scene.cloud().show(ball(20'000));
    scene.frame();
    scene.cloud().set_coarse(coarse_before);
    scene.cut(Section{0, 0.0});
    scene.cloud().set_coarse(coarse);
  });
}

TEST(CoarseClouds, AreCutWhicheverIsDrawnThen) {
  EXPECT_LT(covered(cut(false, false)), 0.8 * covered(drawn_ball(20'000, false)));
  for (const bool coarse : {false, true}) EXPECT_EQ(cut(!coarse, coarse), cut(coarse, coarse)) << coarse;
}

}  // namespace
}  // namespace nextview

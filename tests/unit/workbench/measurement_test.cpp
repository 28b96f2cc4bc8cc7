// What the user measures between points, against shapes whose sizes are known.
#include "ui/workbench/measurement.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double pi = 3.14159265358979;

/// On a circle around (0.1, 0.2, 0.3) whose axis is not one of the world's.
Vector3 on_rim(double radius, double angle, double along = 0.0) {
  const Vector3 axis = Vector3(1, 2, 3).normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
  return Vector3(0.1, 0.2, 0.3) + radius * (std::cos(angle) * u + std::sin(angle) * v) + along * axis;
}

TEST(Measurement, ThreePointsOfARimGiveItsCircle) {
  for (const double last : {2.0, 3.1, 5.9}) {
    const auto circle = circle_through(on_rim(0.02, 0.3), on_rim(0.02, 1.1), on_rim(0.02, last));
    ASSERT_TRUE(circle);
    EXPECT_NEAR(circle->radius, 0.02, 1e-12);
    EXPECT_LT((circle->centre - Vector3(0.1, 0.2, 0.3)).norm(), 1e-12);
    EXPECT_NEAR(std::abs(circle->normal.dot(Vector3(1, 2, 3).normalized())), 1.0, 1e-12);
  }
  EXPECT_FALSE(circle_through({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  EXPECT_FALSE(circle_through({0, 0, 0}, {0, 0, 0}, {2, 2, 2}));
}

/// Points picked by hand lie a millimetre off; the fit to the cloud of the wall does not.
TEST(Measurement, ABoreIsFittedToTheCloudOfItsWall) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.0003);
  std::uniform_real_distribution<double> angle(0, 1.5 * pi), along(-0.004, 0.004), anywhere(-0.2, 0.4);
  std::vector<Eigen::Vector3f> cloud;
  for (int i = 0; i < 3000; ++i)
    cloud.push_back(on_rim(0.02 + noise(random), angle(random), along(random)).cast<float>());
  for (int i = 0; i < 3000; ++i)
    cloud.emplace_back(float(anywhere(random)), float(anywhere(random)), float(anywhere(random)));
  const auto picked = circle_through(on_rim(0.0210, 0.3), on_rim(0.0195, 1.9), on_rim(0.0207, 3.6));
  ASSERT_TRUE(picked);
  EXPECT_GT(std::abs(picked->radius - 0.02), 0.0003) << "the picks are too good for this test";
  const FittedCircle fit = fitted(*picked, cloud);
  EXPECT_GT(fit.points, 2000u);
  EXPECT_NEAR(fit.radius, 0.02, 0.0001);
  EXPECT_NEAR(fit.residual, 0.0003, 0.00015);
  EXPECT_EQ(fitted(*picked, {}).points, 0u);
  EXPECT_EQ(fitted(*picked, {}).radius, picked->radius);
}

TEST(Measurement, IsToldInWords) {
  const Measurement distance{MeasureKind::distance, {{0, 0, 0}, {0.03, 0.04, 0}}};
  EXPECT_EQ(measured_text(distance, {}), "Distance 50 mm (dx 30, dy 40, dz 0 mm)");
  const Measurement plane{MeasureKind::plane, {{0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1}, {3, 4, 0.1125}}};
  EXPECT_EQ(measured_text(plane, {}), "Distance to the plane 12.5 mm");
  const Measurement line{MeasureKind::plane, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 4, 1}}};
  EXPECT_EQ(measured_text(line, {}), "The three points lie on a line");
  const Measurement bore{MeasureKind::bore, {on_rim(0.02, 0), on_rim(0.02, 2), on_rim(0.02, 4)}};
  EXPECT_EQ(measured_text(bore, {}), "Diameter 40 mm through the three points");
  EXPECT_EQ(measure_hint({MeasureKind::distance, {{0, 0, 0}}}), "Distance: click the second point");
  EXPECT_THAT(measure_hint({MeasureKind::plane, {}}), StartsWith("Distance to a plane: click the first"));
  EXPECT_THAT(measure_hint({MeasureKind::bore, {}}), HasSubstr("rim"));
}

}  // namespace
}  // namespace nextview

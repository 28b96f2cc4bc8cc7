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

/// What scans of a bore of 20 mm radius have: three quarters of its wall to a depth, the face around it, noise, and
/// points that belong to neither.
std::vector<Eigen::Vector3f> cloud_of_bore(double depth) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.0003);
  std::uniform_real_distribution<double> angle(0, 1.5 * pi), part(0, 1), anywhere(-0.2, 0.4);
  std::vector<Eigen::Vector3f> cloud;
  const auto add = [&](const Vector3& p) {
    cloud.push_back((p + Vector3(noise(random), noise(random), noise(random))).cast<float>());
  };
  for (int i = 0; i < 3000; ++i) {
    if (depth > 0.0) add(on_rim(0.02, angle(random), -depth * part(random)));
    add(on_rim(std::sqrt(0.02 * 0.02 + part(random) * 0.002), angle(random)));
    cloud.emplace_back(float(anywhere(random)), float(anywhere(random)), float(anywhere(random)));
  }
  return cloud;
}

/// Points picked by hand lie a millimetre off, on the face or down the wall; the fit to the cloud does not.
TEST(Measurement, ABoreIsFittedToTheCloudOfItsWall) {
  const auto cloud = cloud_of_bore(0.03);
  for (const double turned : {0.0, 1.0, 2.5}) {
    const auto picked = circle_through(on_rim(0.0212, turned + 0.3, 0.001), on_rim(0.0198, turned + 1.9, -0.002),
                                       on_rim(0.0209, turned + 3.6));
    ASSERT_TRUE(picked);
    EXPECT_GT(std::abs(picked->radius - 0.02), 0.0003) << "the picks are too good for this test";
    const FittedCircle fit = fitted(*picked, cloud);
    EXPECT_GT(fit.points, 200u);
    EXPECT_FALSE(fit.doubtful);
    EXPECT_NEAR(fit.radius, 0.02, 0.0001);
    EXPECT_NEAR(fit.residual, 0.0003, 0.00015);
    EXPECT_LT((fit.centre - Vector3(0.1, 0.2, 0.3)).norm(), 0.0003) << "in the plane of the face";
    EXPECT_GT(std::abs(fit.normal.dot(Vector3(1, 2, 3).normalized())), 0.9999);
  }
  const auto picked = circle_through(on_rim(0.0210, 0.3), on_rim(0.0195, 1.9), on_rim(0.0207, 3.6));
  EXPECT_EQ(fitted(*picked, {}).points, 0u);
  EXPECT_EQ(fitted(*picked, {}).radius, picked->radius);
}

TEST(Measurement, APinIsFittedToTheCloudOfItsWall) {
  std::vector<Eigen::Vector3f> cloud;
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 40; ++k) {
      cloud.push_back(on_rim(0.02, 0.063 * i, -0.0005 * k).cast<float>());
      cloud.push_back(on_rim(0.0005 * k, 0.063 * i).cast<float>());               // its end
      cloud.push_back(on_rim(0.02 + 0.001 * k, 0.063 * i, -0.02).cast<float>());  // what it stands on
    }
  const auto picked = circle_through(on_rim(0.0195, 0.3), on_rim(0.0198, 1.9), on_rim(0.0193, 3.6));
  const FittedCircle fit = fitted(*picked, cloud);
  EXPECT_FALSE(fit.doubtful);
  EXPECT_NEAR(fit.radius, 0.02, 0.00005);
  EXPECT_LT((fit.centre - Vector3(0.1, 0.2, 0.3)).norm(), 0.0002);
}

/// A hole in a sheet has no wall to tell: what lies around the rim is all there is.
TEST(Measurement, AHoleInASheetIsAsWideAsWhatLiesAroundItsRim) {
  const auto picked = circle_through(on_rim(0.0210, 0.3), on_rim(0.0195, 1.9), on_rim(0.0205, 3.6));
  const FittedCircle fit = fitted(*picked, cloud_of_bore(0.002));
  EXPECT_FALSE(fit.doubtful);
  EXPECT_GT(fit.points, 50u);
  EXPECT_NEAR(fit.radius, 0.02, 0.001);
}

/// Three clicks on a face, and over an edge: a circle goes through them, but there is none.
TEST(Measurement, WhatIsNoBoreIsDoubtful) {
  std::vector<Eigen::Vector3f> face, edge;
  for (int i = 0; i < 200; ++i)
    for (int k = 0; k < 200; ++k) {
      face.emplace_back(0.0005f * float(i), 0.0005f * float(k), 0.0f);
      if (i < 100) edge.push_back(face.back());
      if (i < 100) edge.emplace_back(0.05f, 0.0005f * float(k), -0.0005f * float(i));
    }
  const Measurement on_face{MeasureKind::bore, {{0.04, 0.05, 0}, {0.06, 0.05, 0}, {0.05, 0.062, 0}}};
  const auto none = measured_circle(on_face, face);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->doubtful) << 1e3 * none->radius;
  EXPECT_THAT(measured_text(on_face, none), StartsWith("No clear rim there: a circle of "));
  const Measurement over_edge{MeasureKind::bore, {{0.04, 0.05, 0}, {0.05, 0.055, -0.002}, {0.045, 0.062, 0}}};
  const auto bent = measured_circle(over_edge, edge);
  ASSERT_TRUE(bent);
  EXPECT_TRUE(bent->points == 0 || bent->doubtful) << bent->points << " " << 1e3 * bent->radius;
}

TEST(Measurement, IsToldInWords) {
  const Measurement distance{MeasureKind::distance, {{0, 0, 0}, {0.03, 0.04, 0}}};
  EXPECT_EQ(measured_text(distance, {}), "Distance 50 mm (dx 30, dy 40, dz 0 mm)");
  const Measurement plane{MeasureKind::plane, {{0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1}, {3, 4, 0.1125}}};
  EXPECT_EQ(measured_text(plane, {}), "Distance to the plane 12.5 mm");
  const Measurement line{MeasureKind::plane, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 4, 1}}};
  EXPECT_EQ(measured_text(line, {}), "The three points lie on a line");
  const Measurement bore{MeasureKind::bore, {on_rim(0.02, 0), on_rim(0.02, 2), on_rim(0.02, 4)}};
  EXPECT_EQ(measured_text(bore, measured_circle(bore, {})), "Diameter 40 mm through the three points");
  EXPECT_EQ(measure_hint({MeasureKind::distance, {{0, 0, 0}}}), "Distance: click the second point");
  EXPECT_THAT(measure_hint({MeasureKind::plane, {}}), StartsWith("Distance to a plane: click the first"));
  EXPECT_THAT(measure_hint({MeasureKind::bore, {}}), HasSubstr("rim"));
}

}  // namespace
}  // namespace nextview

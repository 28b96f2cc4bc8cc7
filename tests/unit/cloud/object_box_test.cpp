#include "core/cloud/object_box.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

/// The corners of a box [m]: all that its extents need.
PointCloud corners(const Vector3& low, const Vector3& high) {
  PointCloud points;
  for (int k = 0; k < 8; ++k)
    points.push_back(
        Vector3(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(), k & 4 ? high.z() : low.z()).cast<float>());
  return points;
}

void expect_box(const Eigen::AlignedBox3d& box, const Vector3& low, const Vector3& high) {
  EXPECT_LT((box.min() - low).norm(), 1e-6) << box.min().transpose() << " is not " << low.transpose();
  EXPECT_LT((box.max() - high).norm(), 1e-6) << box.max().transpose() << " is not " << high.transpose();
}

/// A front that was seen: as wide along y as along x, so that both horizontal ways are alike.
const Vector3 low(-0.05, -0.1, 0.0), high(0.05, 0.1, 0.3);
const std::vector<Vector3> no_planes;

TEST(ObjectBox, GoesOnAwayFromTheCamerasByWhatDepthItLacks) {
  // 20 cm wide as seen along x: 30 cm deep, of which 10 were seen.
  expect_box(object_box(corners(low, high), Vector3::UnitX(), no_planes), {-0.25, -0.1, 0.0}, high);
  expect_box(object_box(corners(low, high), -Vector3::UnitX(), no_planes), low, {0.25, 0.1, 0.3});
  // 10 cm wide as seen along y: 15 cm deep, and 20 were seen.
  expect_box(object_box(corners(low, high), Vector3::UnitY(), no_planes), low, high);
}

TEST(ObjectBox, OfWhatWasSeenFromAboveGoesDown) {
  const Vector3 flat_low(-0.1, -0.1, 0.25), flat_high(0.1, 0.1, 0.3);
  expect_box(object_box(corners(flat_low, flat_high), Vector3::UnitZ(), no_planes), {-0.1, -0.1, 0.0}, flat_high);
}

TEST(ObjectBox, GoesOnByLessWhereItWasSeenFromSeveralSides) {
  for (const double one_sided : {0.8, 0.5, 0.2})
    expect_box(object_box(corners(low, high), one_sided * Vector3::UnitX(), no_planes),
               {-0.05 - 0.2 * one_sided, -0.1, 0.0}, high);
}

// From about a tenth on there is a way that is away from the cameras.
TEST(ObjectBox, IsThatOfThePointsWhereItWasSeenFromAllAround) {
  for (const double one_sided : {0.0, 0.05, 0.0999})
    expect_box(object_box(corners(low, high), one_sided * Vector3::UnitX(), no_planes), low, high);
  expect_box(object_box(corners(low, high), 0.1 * Vector3::UnitX(), no_planes), {-0.07, -0.1, 0.0}, high);
}

TEST(ObjectBox, GoesThroughNoPlane) {
  const Vector3 obliquely(0.6, 0.0, 0.8);
  const std::vector<Vector3> ground = {Vector3::UnitZ()}, ground_and_wall = {Vector3::UnitZ(), Vector3::UnitX()};
  expect_box(object_box(corners(low, high), obliquely, ground), {-0.25, -0.1, 0.0}, high);
  expect_box(object_box(corners(low, high), obliquely, ground_and_wall), low, high);
  // A plane before which the object goes on is none that it would go through.
  const std::vector<Vector3> behind_the_cameras = {-Vector3::UnitX()};
  expect_box(object_box(corners(low, high), Vector3::UnitX(), behind_the_cameras), {-0.25, -0.1, 0.0}, high);
}

TEST(ObjectBox, OfNoPointsIsEmpty) { EXPECT_TRUE(object_box({}, Vector3::UnitX(), no_planes).isEmpty()); }

}  // namespace
}  // namespace nextview

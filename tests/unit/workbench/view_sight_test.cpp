// A view is placed where the sensor sees the object, and an empty one says why: a sphere of 0.15 m around the origin,
// and a sensor from 0.2 to 1.5 m.
#include "ui/workbench/view_sight.hpp"

#include <gmock/gmock.h>

#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

std::shared_ptr<const SessionSnapshot> ball() {
  SessionRunner runner;
  runner.load(small_scan(), job_control());
  return runner.snapshot();
}

Pose from(double x, double y, double z) { return look_at(Vector3(x, y, z), Vector3::Zero()); }

TEST(ViewSight, AnEmptyViewSaysWhy) {
  const auto s = ball();
  const double r = s->mesh->bounding_box().max().x(), reach = s->configuration.sensor.max_range;
  EXPECT_EQ(why_empty(*s, from(0.8, 0, 0.1)), "");
  EXPECT_EQ(why_empty(*s, from(0, r + 0.9 * reach, 0)), "");
  EXPECT_THAT(why_empty(*s, from(r + 1.1 * reach, 0, 0)), HasSubstr("and the sensor reaches 1.5 m"));
  EXPECT_EQ(why_empty(*s, from(0.3 * r, 0.1 * r, 0)), "the camera is inside the object");
  EXPECT_EQ(why_empty(*s, look_at(Vector3(0.8, 0, 0), Vector3(1.6, 0, 0))), "it looks past the object");
  EXPECT_EQ(why_empty(*s, look_at(Vector3(0.8, 0, 0), Vector3(0.8, 0.8, 0.1))), "it looks past the object");
  EXPECT_THAT(why_empty(*s, from(0, 0.03 + r, 0)), HasSubstr("and the sensor needs 200 mm"));
  EXPECT_EQ(why_empty(SessionSnapshot(), from(1, 0, 0)), "");
}

TEST(ViewSight, AViewIsMovedAlongItsLineOfSight) {
  const auto s = ball();
  for (const Pose& view : {from(3, 1, 2), from(0.02, 0, 0.01), from(0, 0.17, 0.02),
                           look_at(Vector3(0, -4, 0.5), Vector3(0.05, 0, 0.02))}) {
    ASSERT_NE(why_empty(*s, view), "");
    const PlacedView placed = within_sight(*s, view);
    EXPECT_EQ(why_empty(*s, placed.T_world_camera), "");
    EXPECT_TRUE(placed.T_world_camera.linear().isApprox(view.linear())) << "it looks elsewhere";
    const Vector3 way = placed.T_world_camera.translation() - view.translation();
    EXPECT_TRUE(way.isApprox(placed.moved * view.linear().col(2), 1e-9)) << "it is not on the line of sight";
  }
}

TEST(ViewSight, AViewThatSeesSomethingOrNeverWillStays) {
  const auto s = ball();
  for (const Pose& view : {from(0.7, 0.2, 0.3), look_at(Vector3(3, 0, 0), Vector3(3, 2, 0))}) {
    const PlacedView placed = within_sight(*s, view);
    EXPECT_TRUE(placed.T_world_camera.isApprox(view));
    EXPECT_EQ(placed.moved, 0.0);
  }
}

}  // namespace
}  // namespace nextview

// Dragging a box by handles, against the geometry by hand.
#include "ui/window/box_handles.hpp"

#include <gtest/gtest.h>

#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

using Box = Eigen::AlignedBox3d;

const Box box{Vector3(-1, -2, 0), Vector3(1, 2, 3)};
const Vector3 eye(4, -9, 5);

Sight towards(const Vector3& point) { return {eye, point - eye}; }

TEST(BoxHandles, AreTheMiddlesOfTheFacesAndTheCentre) {
  for (std::size_t handle = 0; handle < centre_handle; ++handle) {
    const Vector3 outward = handle_place(box, handle) - box.center();
    const Vector3 expected = (handle % 2 == 1 ? 0.5 : -0.5) * box.sizes().cwiseProduct(Vector3::Unit(long(handle / 2)));
    EXPECT_TRUE(outward.isApprox(expected)) << handle;
  }
  EXPECT_EQ(handle_place(box, centre_handle), box.center());
}

/// The nearest of many points tried.
TEST(BoxHandles, AlongALineIsWhereItComesNearestToTheSight) {
  for (std::uint64_t i = 0; i < 30; ++i) {
    const auto d = CounterRandom(4, 1).uniform(i), e = CounterRandom(4, 2).uniform(i),
               f = CounterRandom(4, 3).uniform(i);
    const Vector3 point(d[0], d[1], e[0]), along = Vector3(e[1] - 0.5, f[0] - 0.5, f[1]).normalized();
    const Sight sight = towards(Vector3(f[0], d[1], e[1]));
    const auto found = along_line(point, along, sight);
    ASSERT_TRUE(found);
    const auto distance = [&](double t) {
      const Vector3 from_eye = point + t * along - sight.origin;
      return from_eye.cross(sight.direction).norm() / sight.direction.norm();
    };
    for (const double step : {-0.1, -0.001, 0.001, 0.1}) EXPECT_LT(distance(*found), distance(*found + step));
  }
}

TEST(BoxHandles, ALineThatIsLookedAlongTellsNothing) {
  EXPECT_FALSE(along_line(Vector3::Zero(), Vector3::UnitX(), {{-5, 0.1, 0}, {1, 0, 0}}));
  EXPECT_TRUE(along_line(Vector3::Zero(), Vector3::UnitX(), {{-5, 0.1, 0}, {1, 0.3, 0}}));
}

TEST(BoxHandles, AFaceFollowsThePointerAlongItsAxisAlone) {
  for (std::size_t handle = 0; handle < centre_handle; ++handle) {
    const auto axis = long(handle / 2);
    const Vector3 place = handle_place(box, handle), shift = 0.5 * Vector3::Unit(axis);
    const Box moved = dragged(box, handle, towards(place), towards(place + shift), {0, 1, 0}, 0.1);
    Box expected = box;
    (handle % 2 == 1 ? expected.max() : expected.min()) += shift;
    EXPECT_TRUE(moved.isApprox(expected)) << handle << ": " << region_text(moved);
  }
}

TEST(BoxHandles, APressBesideAHandleMovesNothingByItself) {
  const Sight beside = towards(handle_place(box, 1) + Vector3(0.07, 0.05, 0.02));
  EXPECT_TRUE(dragged(box, 1, beside, beside, {0, 1, 0}, 0.1).isApprox(box));
}

TEST(BoxHandles, FacesGoByWholeVoxelsAndDoNotPassEachOther) {
  const Vector3 place = handle_place(box, 1);
  const auto dragged_to = [&](double x) {
    return dragged(box, 1, towards(place), towards(place + Vector3(x, 0, 0)), {0, 1, 0}, 0.1).max().x();
  };
  EXPECT_NEAR(dragged_to(0.26), 1.3, 1e-9);
  EXPECT_NEAR(dragged_to(-1.99), -0.9, 1e-9) << "a voxel stays";
  const Box wide = dragged(box, 0, towards(handle_place(box, 0)), towards(Vector3(-20, 0, 1.5)), {0, 1, 0}, 0.01);
  EXPECT_NEAR(wide.sizes().x(), 5.12, 1e-9) << "no more than 512 voxels";
}

TEST(BoxHandles, TheCentreTakesTheBoxAlongAcrossTheLineOfSight) {
  const Vector3 forward(0, 1, 0), centre = box.center();
  const Box moved = dragged(box, centre_handle, towards(centre), towards(centre + Vector3(0.5, 0, -0.3)), forward, 0.1);
  EXPECT_TRUE(moved.isApprox(box.translated(Vector3(0.5, 0, -0.3)))) << region_text(moved);
  const Box behind = dragged(box, centre_handle, towards(centre), {eye, eye - centre}, forward, 0.1);
  EXPECT_TRUE(behind.isApprox(box)) << "behind the eye is nowhere";
}

TEST(BoxHandles, TheTextIsTheSettings) {
  EXPECT_EQ(region_text({Vector3(-0.3, 1e-17, 0.1 * 3), Vector3(0.12, 2, 5)}), "-0.3 0 0.3 0.12 2 5");
}

}  // namespace
}  // namespace nextview

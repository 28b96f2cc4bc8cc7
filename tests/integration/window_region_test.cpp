// The region of interest, dragged in the scene.
#include <gtest/gtest.h>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/integration/window_pixels.hpp"
#include "ui/appearance/theme.hpp"
#include "ui/window/box_handles.hpp"

namespace nextview {
namespace {

Eigen::AlignedBox3d region(User& user) { return user.session().grid.box(); }

Point pixel_of(User& user, const Vector3& place) {
  const auto pixel = user.window().scene().project(place);
  return {pixel->x(), pixel->y()};
}

class WindowRegion : public testing::Test {
 protected:
  WindowRegion() { user_.run_quickly("step\nedit-region\n"); }
  /// Presses on the handle and moves it there, without letting go.
  void drag(std::size_t handle, const Vector3& by) {
    const Vector3 place = handle_place(region(user_), handle);
    const Point from = pixel_of(user_, place), to = pixel_of(user_, place + by);
    user_.move(from.x, from.y);
    user_.press();
    user_.wait_for_news();
    user_.move((from.x + to.x) / 2, (from.y + to.y) / 2);
    user_.wait_for_news();
    user_.move(to.x, to.y);
    user_.wait_for_news();
  }

  User user_{small_scan()};
};

TEST_F(WindowRegion, AFaceThatIsLetGoIsTheSettingAndStartsOver) {
  const Eigen::AlignedBox3d before = region(user_);
  const Pose camera = user_.window().scene().camera_pose();
  drag(5, {0, 0, -0.2});  // the top
  EXPECT_EQ(user_.session().records.size(), 1u) << "it is not let go";
  EXPECT_TRUE(user_.window().scene().camera_pose().isApprox(camera)) << "the camera is not what is dragged";
  user_.release();
  user_.wait_for_news();
  EXPECT_EQ(user_.session().records.size(), 1u) << "it is asked first";
  EXPECT_TRUE(user_.window().question().starts_with("Another region of interest starts the scan over."));
  user_.run_quickly("answer \"Start over\"\n");
  EXPECT_EQ(user_.session().message, "");
  EXPECT_TRUE(user_.session().records.empty());
  Eigen::AlignedBox3d expected = before;
  expected.max().z() -= 0.2;
  EXPECT_TRUE(region(user_).isApprox(expected)) << region_text(region(user_));
  EXPECT_EQ(user_.session().configuration.map.region, region_text(expected));
  EXPECT_TRUE(user_.window().state().edit_region) << "another side can be dragged";
  user_.run_quickly("undo\n");
  EXPECT_EQ(user_.session().records.size(), 1u);
  EXPECT_TRUE(region(user_).isApprox(before));
}

TEST_F(WindowRegion, TheLegendsStayLegible) {
  user_.run("zoom 6\n");
  const SceneView& scene = user_.window().scene();
  const Rectangle place = scene.rectangle(), beneath = scene.beside_legends()[1];
  const Rectangle legends{beneath.x, place.y, beneath.width, place.height - beneath.height};
  const auto blue = [&](const Rectangle& r) { return count(user_.look(), r, theme::series[0]); };
  const int all = blue(place), there = blue(legends);
  user_.run("edit-region\n");
  EXPECT_LT(blue(place), all - 100) << "the handles are gone";
  EXPECT_EQ(blue(legends), there);
}

TEST_F(WindowRegion, EscapeLeavesAndChangesNothing) {
  const Eigen::AlignedBox3d before = region(user_);
  drag(1, {0.2, 0, 0});
  user_.type(Key::escape);
  user_.wait_for_news();
  EXPECT_FALSE(user_.window().state().edit_region);
  user_.release();
  user_.wait_for_news();
  EXPECT_TRUE(region(user_).isApprox(before));
  EXPECT_EQ(user_.session().records.size(), 1u);
}

TEST_F(WindowRegion, ARegionThatIsRefusedGoesBackAndIsSaid) {
  const Eigen::AlignedBox3d before = region(user_);
  drag(centre_handle, {0.9, 0.0, 0.0});  // away from the object
  user_.release();
  user_.wait_for_news();
  user_.run_quickly("answer \"Start over\"\n");
  EXPECT_NE(user_.session().message, "");
  EXPECT_TRUE(region(user_).isApprox(before));
  EXPECT_EQ(user_.session().records.size(), 1u);
}

TEST_F(WindowRegion, HandlesAreSeenWhileTheyCanBeDragged) {
  user_.wait();
  const Rectangle scene = user_.window().layout().scene;
  const int with = count(user_.look(), scene, theme::series[0]);
  user_.run("edit-region\n");
  EXPECT_GT(with, count(user_.look(), scene, theme::series[0]) + 6 * 60);
}

}  // namespace
}  // namespace nextview

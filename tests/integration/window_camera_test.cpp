// How the scene's camera follows hand and keys, what is measured with clicks, and what else of the window has a size.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include <cmath>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/integration/window_pixels.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "ui/appearance/theme.hpp"

namespace nextview {
namespace {

class WindowCamera : public testing::Test {
 protected:
  WindowCamera() { user_.run("step\n"); }
  SceneView& scene() { return user_.window().scene(); }
  /// On the sphere, on the side of the scene's camera, off its middle to the right and up.
  Vector3 on_sphere(double right, double up) {
    const Pose camera = scene().camera_pose();
    const double radius = user_.session().mesh->bounding_box().sizes().maxCoeff() / 2;
    const Vector3 towards = camera.translation().normalized();
    return radius * (towards + right * camera.linear().col(0) - up * camera.linear().col(1)).normalized();
  }
  Eigen::Vector2d pixel_of(const Vector3& point) { return scene().project(point).value(); }

  User user_{small_scan()};
};

TEST_F(WindowCamera, ADragTurnsAroundWhatIsUnderThePointer) {
  const Pose before = scene().camera_pose();
  const Eigen::Vector2d place = pixel_of(on_sphere(0.3, 0.2));
  user_.move(place.x(), place.y());
  user_.press();
  user_.wait();
  const Eigen::Vector2d grasped = pixel_of(scene().pivot());
  EXPECT_LT((grasped - place).norm(), 25.0) << "a voxel under the pointer";
  user_.move(place.x() + 90, place.y() - 40);
  user_.wait();
  EXPECT_FALSE(scene().camera_pose().isApprox(before));
  EXPECT_LT((pixel_of(scene().pivot()) - grasped).norm(), 0.5) << "it slipped away";
  user_.release();
  user_.wait();
}

TEST_F(WindowCamera, EdgesAreRoughWhileItMovesAndSmoothOnceItRests) {
  const auto samples = [&] { return user_.target().window().GetMultiSamples(); };
  const Eigen::Vector2d place = pixel_of(on_sphere(0.3, 0.2));
  user_.move(place.x(), place.y());
  user_.press();
  user_.wait();
  EXPECT_EQ(samples(), RenderTarget::smooth_samples);
  user_.move(place.x() + 60, place.y());
  for (int i = 0; i < 3; ++i) user_.window().draw(1.0 / 60);
  EXPECT_EQ(samples(), 0) << "somebody waits for each of these pictures";
  EXPECT_FALSE(user_.window().is_drawn_well());
  user_.wait();
  EXPECT_EQ(samples(), RenderTarget::smooth_samples);
  user_.release();
  user_.wait();
}

/// While it is looked at the overlay draws it; once it is next, the scene does.
TEST_F(WindowCamera, ACustomViewIsDrawnOnce) {
  user_.run_quickly("undo\ncustom-view\nlook-from 0 80\n");
  const auto names = [&] {
    std::size_t count = 0;
    for (const Label& label : scene().layers().views().labels()) count += label.text == "custom view";
    return count;
  };
  EXPECT_EQ(names(), 0u);
  user_.run_quickly("step\ncustom-view\nlook-from 0 10\ntake-custom-view\n");
  ASSERT_TRUE(user_.session().custom_next_view);
  EXPECT_EQ(names(), 1u);
}

TEST_F(WindowCamera, APressFarFromWhereThePointerWasTurnsNothing) {
  user_.move(user_.window().layout().left.x + 20, 300);
  user_.wait();
  const Pose before = scene().camera_pose();
  const Eigen::Vector2d place = pixel_of(on_sphere(0, 0));
  user_.click(place.x(), place.y());
  user_.wait();
  EXPECT_TRUE(scene().camera_pose().isApprox(before));
}

TEST_F(WindowCamera, TheWheelGoesToWhatIsUnderThePointer) {
  const Eigen::Vector2d place = pixel_of(on_sphere(0.4, -0.3));
  user_.move(place.x(), place.y());
  user_.wait();
  const double before = scene().camera_pose().translation().norm();
  for (int i = 0; i < 6; ++i) user_.window().push(input::Wheel{1});
  user_.wait();
  EXPECT_LT(scene().camera_pose().translation().norm(), 0.8 * before);
  EXPECT_LT((pixel_of(scene().pivot()) - place).norm(), 25.0) << "within a voxel of the pointer";
}

TEST_F(WindowCamera, ADoubleClickBringsAPointToTheMiddle) {
  const Eigen::Vector2d place = pixel_of(on_sphere(0.4, 0.3));
  user_.click(place.x(), place.y());
  user_.click(place.x(), place.y());
  user_.wait();
  const Rectangle r = user_.window().layout().scene;
  const Eigen::Vector2d middle_of_scene(r.x + r.width / 2, r.y + r.height / 2);
  EXPECT_LT((pixel_of(scene().pivot()) - middle_of_scene).norm(), 1.0);
}

/// A part whose sides fill what the legends leave; with legends, in half of the scene, and without legends.
TEST(WindowFraming, TheAxesStandFreeOfThePartFromEverySide) {
  Configuration box = small_scan();
  box.object.file = "box";
  User user(box);
  user.run_quickly("step\nstep\n");
  SceneView& scene = user.window().scene();
  for (const std::string with : {"second-view none", "second-view cloud", "second-view none\ntoggle-legends"}) {
    user.run_quickly(with + "\n");
    for (const char* side : {"front", "right", "back", "left", "top", "bottom", "usual"}) {
      user.run_quickly(fmt::format("standard-view {}\n", side));
      const Rectangle& r = scene.rectangle();
      int covered = 0;
      for (const Eigen::Vector3f& vertex : user.session().mesh->vertices)
        if (const auto p = scene.project(vertex.cast<double>()))
          covered += p->x() < r.x + 94 && p->y() > r.y + r.height - 90;
      EXPECT_EQ(covered, 0) << side << ", " << with;
    }
    const double legends = scene.beside_legends()[1].width;
    EXPECT_EQ(legends > 100, !with.ends_with("legends")) << with;
    EXPECT_LT(legends, 0.7 * scene.rectangle().width) << with;
  }
}

/// Its region is as large as that of the scan that it is of, more than twice as wide as the object.
TEST_F(WindowCamera, ARecordingIsFramedOnWhatItsFramesShowBeforeAnyIsTaken) {
  const TemporaryFolder folder;
  user_.run_quickly("step\nexport " + (folder.path() / "scan").string() + "\n");
  Configuration recorded;
  recorded.recorded.folder = folder.path() / "scan";
  User other(recorded);
  ASSERT_TRUE(other.session().is_recording());
  ASSERT_TRUE(other.session().records.empty());
  SceneView& view = other.window().scene();
  Eigen::AlignedBox2d seen;
  for (const Eigen::Vector3f& point : other.session().setup->recorded->samples())
    seen.extend(view.project(point.cast<double>()).value());
  const Rectangle& r = view.rectangle();
  EXPECT_TRUE(
      Eigen::AlignedBox2d(Eigen::Vector2d(r.x, r.y), Eigen::Vector2d(r.x + r.width, r.y + r.height)).contains(seen));
  EXPECT_GT(seen.sizes().y(), 0.7 * r.height);
}

TEST_F(WindowCamera, ArrowsTurnAndFComesBack) {
  const Image framed = user_.look();
  const Pose before = scene().camera_pose();
  user_.type(Key::left);
  user_.wait();
  EXPECT_FALSE(scene().camera_pose().isApprox(before));
  const double turned = std::acos(scene().camera_pose().linear().col(0).dot(before.linear().col(0)));
  EXPECT_NEAR(turned * 180 / M_PI, 10, 0.1);
  user_.type(Key::right);
  user_.wait();
  EXPECT_TRUE(scene().camera_pose().isApprox(before, 1e-9));
  user_.type(Key::up);
  user_.type(key('F'));
  user_.wait();
  EXPECT_EQ(user_.look(), framed);
}

/// Against the points that were clicked: within a hundredth.
TEST_F(WindowCamera, AKnownDistanceIsMeasuredByTwoClicks) {
  const Vector3 a = on_sphere(-0.5, 0.1), b = on_sphere(0.4, -0.4);
  user_.type(key('M'));
  user_.wait();
  for (const Vector3& point : {a, b}) {
    const Eigen::Vector2d place = pixel_of(point);
    user_.click(place.x(), place.y());
    user_.wait();
  }
  const auto& measurement = user_.window().state().measurement;
  ASSERT_TRUE(measurement && measurement->complete());
  const double measured = (measurement->points[1] - measurement->points[0]).norm();
  EXPECT_NEAR(measured, (b - a).norm(), 0.01 * (b - a).norm());
  EXPECT_TRUE(user_.worker().log().entries()->back().text.starts_with("Distance ")) << "it is not said";
  user_.type(Key::escape);
  user_.wait();
  EXPECT_FALSE(user_.window().state().measurement);
}

TEST_F(WindowCamera, WhatWasMeasuredIsLegibleBesideTheLegends) {
  const Rectangle beneath = scene().beside_legends()[1];
  const auto measured = [&](double left_of_legends) {
    const Sight sight = scene().sight(beneath.x - left_of_legends, beneath.y - 40);
    const Vector3 point = sight.origin + sight.direction;
    user_.run(fmt::format("measure\nmeasure-point {0} {1} {2}\nmeasure-point {0} {1} {2}\n", point.x(), point.y(),
                          point.z()));
    const int red = count(user_.look(), scene().rectangle(), theme::chosen);
    user_.run("measure bore\nmeasure\n");  // no more
    return red - count(user_.look(), scene().rectangle(), theme::chosen);
  };
  const int far = measured(400), near = measured(20);
  EXPECT_GT(far, 50);
  EXPECT_GT(near, 0.8 * far) << "the rest is beneath them";
}

TEST_F(WindowCamera, TextGrowsAndComesBackToTheSamePicture) {
  const Image usual = user_.look();
  const double bar = user_.window().layout().control_bar.height;
  user_.run("text-size bigger\n");
  EXPECT_NEAR(user_.window().layout().control_bar.height, 1.25 * bar, 1.0);
  EXPECT_NE(user_.look(), usual);
  user_.run("text-size usual\nframe\n");
  EXPECT_EQ(user_.look(), usual);
}

TEST_F(WindowCamera, TheSceneAloneHasAllButTheMenu) {
  const Image usual = user_.look();
  user_.run("hide-panels\n");
  const Layout& layout = user_.window().layout();
  EXPECT_EQ(layout.scene.width, layout.width);
  EXPECT_NEAR(layout.scene.height + layout.menu.height, layout.height, 2.0);
  EXPECT_GT(count_amber(user_.look(), layout.scene), count_amber(usual, layout.scene)) << "the object is not larger";
  user_.run("hide-panels\nframe\n");
  EXPECT_EQ(user_.look(), usual);
}

TEST_F(WindowCamera, WhoLooksThroughAViewSeesItsBorder) {
  user_.run("select-taken 1\nlook-through\n");
  const Rectangle r = user_.window().layout().scene;
  EXPECT_GT(count(user_.look(), r, theme::chosen), 400) << "the border of the image is not drawn";
  user_.type(Key::left);
  user_.wait();
  user_.type(key('4'));  // candidates, which are of this colour too
  user_.wait();
  EXPECT_LT(count(user_.look(), r, theme::chosen), 200) << "it is drawn from elsewhere too";
}

}  // namespace
}  // namespace nextview

// What a section lays open, the surface that the views make, and the scene's other ways to be looked at.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/integration/window_pixels.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "ui/appearance/colour_map.hpp"

namespace nextview {
namespace {

class WindowSection : public InTemporaryFolder {
 protected:
  WindowSection() { user_.run_quickly("step\nstep\nobject-style solid\ntoggle-octree\ntoggle-views\ntoggle-rays\n"); }
  SceneView& scene() { return user_.window().scene(); }
  const WindowState& state() { return user_.window().state(); }
  double radius() { return user_.session().mesh->bounding_box().sizes().x() / 2; }
  Eigen::Vector2d pixel_of(const Vector3& point) { return scene().project(point).value(); }
  /// How many pixels have the colour between the lines of the hatching: within a distance of a place of the window, or
  /// farther from it [px].
  int hatched(const Eigen::Vector2d& middle, double from, double to) {
    const Image image = user_.look();
    const Rectangle& r = user_.window().layout().scene;
    int result = 0;
    for (int y = int(r.y); y < int(r.y + r.height); ++y)
      for (int x = int(r.x); x < int(r.x + r.width); ++x) {
        const double away = (Eigen::Vector2d(x + 0.5, y + 0.5) - middle).norm();
        result += away >= from && away < to && count(image, {double(x), double(y), 1, 1}, theme::cut);
      }
    return result;
  }

  User user_{small_scan()};
};

/// A ball that is cut beside its middle is a disc there: its area is known.
TEST_F(WindowSection, CutsTheObjectWhereItIsSaidAndHatchesTheInside) {
  user_.run("toggle-legends\ntoggle-orthographic\nsection-axis x\nstandard-view right\nsection-at 0\n");
  const Eigen::Vector2d middle = pixel_of({0, 0, 0});
  for (const double share : {0.0, 0.5, 0.8}) {
    user_.run(fmt::format("section-at {}\n", share * radius()));
    const double pixels = (pixel_of({0, radius(), 0}) - pixel_of({0, -radius(), 0})).norm() / (2 * radius());
    const double disc = radius() * std::sqrt(1 - share * share) * pixels, area = std::numbers::pi * disc * disc;
    EXPECT_NEAR(hatched(middle, 0, 1.02 * disc), 0.66 * area, 0.04 * area) << share << ": two thirds are between lines";
    EXPECT_LT(hatched(middle, 1.02 * disc, 1e9), 0.01 * area) << share;
  }
  user_.run("flip-section\n");
  const Vector3 cap = scene().surface_point(middle.x(), middle.y()).value();
  EXPECT_NEAR(cap.x(), radius(), 0.02 * radius()) << "the other part is left, and its outside is what is seen";
  user_.run("section-axis none\n");
  EXPECT_LT(hatched(middle, 0, 1e9), 100);
}

TEST_F(WindowSection, ThroughAGhostOnePointsAtWhatWasMeasured) {
  user_.run("step\nlook-from 25 30\nobject-style ghost\n");
  const Eigen::Vector2d middle = pixel_of({0, 0, 0});
  const auto off_cloud = [&] {
    const Vector3 point = scene().surface_point(middle.x(), middle.y()).value();
    double least = 1.0;
    for (const Eigen::Vector3f& p : user_.session().cloud->points)
      least = std::min(least, (p.cast<double>() - point).norm());
    return least;
  };
  if (!state().layers.cloud) user_.run("toggle-cloud\n");
  EXPECT_LT(off_cloud(), 1e-6);
  user_.run("object-style solid\n");
  EXPECT_GT(off_cloud(), 1e-6) << "of the true surface";
  user_.run("object-style ghost\ntoggle-cloud\n");
  EXPECT_GT(off_cloud(), 1e-6) << "nothing else is there to be pointed at";
}

TEST_F(WindowSection, WhatIsCutOffIsNotPicked) {
  user_.run("look-from 0 0\n");
  const Eigen::Vector2d middle = pixel_of({0, 0, 0});
  EXPECT_NEAR(scene().surface_point(middle.x(), middle.y()).value().x(), radius(), 0.02 * radius());
  user_.run("section-axis x\n");
  EXPECT_NEAR(scene().surface_point(middle.x(), middle.y()).value().x(), -radius(), 0.02 * radius())
      << "one looks at the inside of the far half";
  user_.run("toggle-object\ntoggle-octree\n");
  const auto voxel = scene().pick(middle.x(), middle.y()).voxel;
  EXPECT_LE(voxel ? user_.session().grid.centre(*voxel).x() : 0.0, 0.0);
}

TEST_F(WindowSection, TheSurfaceIsPaintedByItsDistanceAndGoesAgain) {
  user_.wait();
  const Image before = user_.look();
  user_.run("toggle-object\n");
  const Image without = user_.look();
  user_.run("toggle-surface\nwait until done\n");
  const Image with = user_.look();
  const Rectangle& place = user_.window().layout().scene;
  EXPECT_GT(colours(with, place), colours(without, place) + 300) << "nothing is painted";
  // The panels are others after each command, whatever the scene shows.
  user_.run("surface-colour single\nsurface-of map\nwait until done\n");
  EXPECT_GT(differences(user_.look(), with, place), 1000);
  user_.run("surface-colour deviation\nsurface-of cloud\nwait until done\n");
  EXPECT_EQ(user_.look(), with);
  user_.run("step\nwait until done\n");
  EXPECT_GT(differences(user_.look(), with, place), 100) << "it is made of all views";
  user_.run("undo\nwait until done\n");
  user_.run("toggle-surface\ntoggle-object\n");  // which stands in for it again
  EXPECT_EQ(colours(user_.look(), place), colours(before, place));
}

TEST_F(WindowSection, WithoutVanishingPointsEqualLengthsLookEqual) {
  user_.run("toggle-octree\n");
  const Image perspective = user_.look();
  const auto length = [&](double depth) {
    const Vector3 forward = scene().camera_pose().linear().col(2), right = scene().camera_pose().linear().col(0);
    return (pixel_of(depth * forward + 0.1 * right) - pixel_of(depth * forward - 0.1 * right)).norm();
  };
  EXPECT_GT(length(-0.2), 1.05 * length(0.2));
  const double middle = length(0.0);
  user_.type(key('O'));
  user_.wait();
  EXPECT_NEAR(length(-0.2), length(0.2), 1e-6);
  EXPECT_NEAR(length(0.0), middle, 0.01 * middle) << "what is in the middle keeps its size";
  const Eigen::Vector2d place = pixel_of({0.05, -0.05, 0.05});
  const Sight sight = scene().sight(place.x(), place.y());
  const Vector3 to = Vector3(0.05, -0.05, 0.05) - sight.origin;
  EXPECT_LT(to.cross(sight.direction.normalized()).norm(), 1e-6) << "a sight goes through what it shows";
  user_.move(place.x(), place.y());
  user_.window().push(input::Wheel{3});
  user_.wait();
  EXPECT_GT(length(0.0), 1.3 * middle);
  user_.run("frame\n");
  user_.move(1, 1);
  user_.type(key('O'));
  user_.run("frame\n");
  EXPECT_EQ(user_.look(), perspective);
}

TEST_F(WindowSection, ASecondSceneShowsAnotherThingUnderTheSameCamera) {
  user_.run("toggle-octree\ntoggle-object\n");
  const Image alone = user_.look();
  const Rectangle whole = user_.window().layout().scene;
  Rectangle left = whole, right = whole;
  left.width = right.width = std::floor(whole.width / 2);
  right.x += left.width;
  user_.run("second-view object\n");
  const Image both = user_.look();
  EXPECT_GT(count_amber(both, left), 1000) << "the octree";
  EXPECT_EQ(count_amber(both, right), 0) << "the object";
  const Pose before = scene().camera_pose();
  user_.move(right.x + 40, right.y + 200);
  user_.press();
  user_.wait();
  user_.move(right.x + 120, right.y + 200);
  user_.wait();
  user_.release();
  user_.wait();
  EXPECT_FALSE(scene().camera_pose().isApprox(before)) << "a drag in the second scene turns both";
  user_.move(1, 1);
  user_.run("second-view none\nframe\n");
  EXPECT_EQ(user_.look(), alone);
}

TEST_F(WindowSection, AnExportedPictureHasBothScenes) {
  const auto exported = [&](const std::string& name) {
    user_.run("export-picture \"" + (folder_ / name).string() + "\" 640x360\n");
    return read_png(folder_ / name);
  };
  user_.run("toggle-octree\ntoggle-object\nsecond-view object\n");
  const Image both = exported("both.png");
  ASSERT_EQ(both.width, 640);
  ASSERT_EQ(both.height, 360);
  EXPECT_GT(count_amber(both, {0, 0, 320, 360}), 1000) << "the octree";
  EXPECT_EQ(count_amber(both, {320, 0, 320, 360}), 0) << "the object";
  user_.run("second-view none\n");
  EXPECT_GT(count_amber(exported("one.png"), {320, 0, 320, 360}), 1000) << "the octree in the middle";
}

TEST_F(WindowSection, DarkIsDarkAndComesBack) {
  user_.wait();
  const Image light = user_.look();
  user_.run("dark\n");
  const Image dark = user_.look();
  double sum = 0;
  for (std::size_t i = 0; i < dark.rgba.size(); i += 4) sum += dark.rgba[i];
  EXPECT_LT(sum / (double(dark.rgba.size()) / 4), 70) << "much of the window stayed light";
  user_.run("text-size bigger\ntext-size usual\nframe\n");
  EXPECT_EQ(user_.look(), dark) << "another size of text is as dark";
  user_.run("dark\n");
  EXPECT_EQ(user_.look(), light);
}

TEST_F(WindowSection, AKeptCameraIsComeBackTo) {
  user_.run("look-from 10 50\nzoom 3\nkeep-camera \"a place\"\n");
  const Pose kept = scene().camera_pose();
  const Image there = user_.look();
  user_.run("frame\nturn 40 10\ngo-to-camera \"a place\"\n");
  EXPECT_TRUE(scene().camera_pose().isApprox(kept, 1e-9));
  EXPECT_EQ(user_.look(), there);
}

TEST_F(WindowSection, KeptCamerasAreUndone) {
  const auto names = [&] {
    std::string all;
    for (const CameraBookmark& camera : *user_.session().cameras) all += camera.name + " ";
    return all;
  };
  user_.run_quickly("keep-camera one\nkeep-camera two\nremove-camera one\n");
  EXPECT_EQ(names(), "two ");
  user_.run_quickly("undo\n");
  EXPECT_EQ(names(), "one two ");
  user_.run_quickly("undo\n");
  EXPECT_EQ(names(), "one ");
  user_.run_quickly("redo\nredo\n");
  EXPECT_EQ(names(), "two ");
}

TEST_F(WindowSection, BordersAreDraggedAndADoubleClickPutsThemBack) {
  const Layout usual = user_.window().layout();
  const double border = usual.left.width, y = usual.left.y + 200;
  user_.move(border, y);
  user_.wait_for_news();
  user_.press();
  user_.wait_for_news();
  user_.move(border + 60, y);
  user_.wait_for_news();
  user_.release();
  user_.wait_for_news();
  EXPECT_NEAR(user_.window().layout().left.width, usual.left.width + 60, 2);
  EXPECT_EQ(user_.window().layout().scene.x, user_.window().layout().left.width + 1);
  user_.run_quickly("panel-sizes 2000 2000 2000\n");
  EXPECT_GE(user_.window().layout().scene.width, 290) << "the scene keeps some of the window";
  EXPECT_GE(user_.window().layout().scene.height, 150);
  const double wide = user_.window().layout().left.width;
  user_.move(wide, y);
  user_.wait_for_news();
  for (int i = 0; i < 2; ++i) user_.click(wide, y);
  user_.wait_for_news();
  EXPECT_EQ(state().place_sizes.left, PlaceSizes().left);
}

}  // namespace
}  // namespace nextview

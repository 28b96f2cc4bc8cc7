// What the pointer does: it turns the scene, picks, and rests for a tooltip.
#include <gtest/gtest.h>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/integration/window_pixels.hpp"
#include "ui/appearance/theme.hpp"

namespace nextview {
namespace {

TEST(Window, ADragThatBeganInTheSceneGoesOnOverPanels) {
  User user(small_scan());
  const Layout layout = user.window().layout();
  const Point in_scene{layout.scene.x + 40, layout.scene.y + 200}, step = step_button(layout);
  user.move(in_scene.x, in_scene.y);
  user.press();
  user.move(step.x + 1, step.y);
  user.wait();
  const std::size_t drawings = user.window().scene_drawings();
  const Image on_panel = user.look();
  user.move(step.x + 30, step.y + 5);
  user.release();
  user.wait();
  EXPECT_GT(user.window().scene_drawings(), drawings);
  EXPECT_GT(differences(user.look(), on_panel, layout.scene), 100);
  EXPECT_TRUE(user.session().records.empty()) << "the release pressed a button";
}

TEST(Window, ADragThatBeganOnAPanelLeavesTheCameraAlone) {
  User user(small_scan());
  user.wait();
  const Layout layout = user.window().layout();
  const Point panel = middle(layout.left), scene = middle(layout.scene);
  const std::size_t drawings = user.window().scene_drawings();
  user.move(panel.x, layout.left.y + layout.left.height - 8);
  user.press();
  user.move(scene.x, scene.y);
  user.release();
  user.wait();
  EXPECT_EQ(user.window().scene_drawings(), drawings);
}

TEST(Window, WhatIsSelectedIsNotDrawnOverTheLegends) {
  User user(small_scan());
  user.run("step\n");
  const Rectangle scene = user.window().layout().scene;
  const Rectangle legends{scene.x + scene.width - 190, scene.y + 20, 180, 60};
  const auto blue = [&](const Rectangle& r) { return count(user.look(), r, theme::series[0]); };
  const int before = blue(legends);
  int in_scene = 0;
  for (std::size_t candidate = 0; candidate < user.session().candidates.size(); ++candidate) {
    user.run("select-view " + std::to_string(candidate) + "\n");
    EXPECT_EQ(blue(legends), before) << candidate;
    in_scene = std::max(in_scene, blue(scene));
  }
  EXPECT_GT(in_scene, before + 100) << "no frustum is seen";
}

TEST(Window, WhereAVoxelIsDrawnAClickInspectsIt) {
  Configuration configuration = small_scan();
  configuration.planner.gain = "occlusion-aware";  // goes to the nearest view: what both saw is occupied
  configuration.planner.weights = {1.0, 1.0};
  User user(configuration);
  user.run("step\nstep\ntoggle-views\ntoggle-rays\ntoggle-cloud\ntoggle-object\n");
  const Rectangle scene = user.window().layout().scene;
  const Image image = user.look();
  int blue = 0, voxels = 0, occupied = 0;
  for (double y = scene.y + 5; y < scene.y + scene.height - 5; y += 7)
    for (double x = scene.x + 5; x < scene.x + scene.width - 5; x += 7) {
      if (count_blue(image, {x - 3, y - 3, 7, 7}) < 49) continue;
      ++blue;
      const auto picked = user.window().scene().pick(x, y);
      voxels += picked.voxel.has_value();
      if (voxels == 3) {
        user.click(x, y);
        user.wait();
        EXPECT_EQ(user.window().state().selection.voxel, picked.voxel) << "the click did not inspect it";
      }
      if (picked.voxel) occupied += (*user.session().voxels)[*picked.voxel].voxel_class == VoxelClass::occupied;
    }
  EXPECT_GT(blue, 15);
  EXPECT_GE(voxels, 0.95 * blue);
  EXPECT_GE(occupied, 0.95 * blue);
}

/// As the window does between events: it sleeps until the next frame would be another one.
void rest(User& user) {
  for (int frames = 0; frames < 100; ++frames) {
    const double seconds = user.window().seconds_to_next_frame();
    if (std::isinf(seconds)) return;
    user.window().draw(seconds + 1e-3);
  }
}

TEST(Window, ATooltipAppearsBesideAPointerThatRests) {
  User user(small_scan());
  user.wait();
  const Layout layout = user.window().layout();
  const Image before = user.look();
  const Point step = step_button(layout), label{layout.left.x + 30, layout.left.y + 32 + 10 + 12};
  for (const Point& place : {step, label}) {
    user.move(place.x, place.y);
    user.wait();
    EXPECT_LT(differences(user.look(), before, layout.left), 100) << "it came at once";
    rest(user);
    EXPECT_GT(differences(user.look(), before, layout.left), 1000) << "no tooltip at " << place.x << ", " << place.y;
    user.move(640, 790);
    user.wait();
    rest(user);
  }
}

TEST(Window, ATooltipGoesWithAKeyUntilThePointerMoves) {
  User user(small_scan());
  user.wait();
  const Layout layout = user.window().layout();
  const Image before = user.look();
  const Point step = step_button(layout);
  const auto changed = [&] {
    user.wait();
    rest(user);
    return differences(user.look(), before, layout.left);
  };
  user.move(step.x, step.y);
  EXPECT_GT(changed(), 1000) << "there is none";
  user.type(Key::escape);
  EXPECT_LT(changed(), 100) << "it lies on the panel while somebody types";
  user.move(step.x + 2, step.y);
  EXPECT_GT(changed(), 1000) << "it does not come back";
}

TEST(Window, AViewThatIsLookedThroughHidesItsOwnPyramid) {
  User user(small_scan());
  user.run("step\nselect-next\ntoggle-region\ntoggle-rays\n");
  const Rectangle scene = user.window().layout().scene;
  const auto red = [](const std::uint8_t* p) { return p[0] > p[1] + 60 && p[0] > p[2] + 60; };
  user.run("look-through\n");
  EXPECT_LT(count(user.look(), scene, red), 0.1 * scene.width * scene.height) << "the pyramid fills the picture";
  EXPECT_GT(count_blue(user.look(), scene), 500) << "the map is not to be seen";
  const Image through = user.look();
  user.run("zoom -3\n");
  EXPECT_GT(differences(user.look(), through, scene), 1000);
  user.run("custom-view 0.6 -0.6 0.5 0 0 0\nlook-through\n");
  EXPECT_GT(count_blue(user.look(), scene), 500) << "the map is not to be seen";
}

std::string log_of(User& user) {
  std::string text;
  for (const LogEntry& entry : *user.worker().log().entries()) text += entry.text + "\n";
  return text;
}

TEST(Window, AViewOfOnesOwnSeesTheObject) {
  User user(small_scan());
  user.run_quickly("step\nzoom -4\ncustom-view\n");
  EXPECT_NE(log_of(user).find("Your view is moved"), std::string::npos) << log_of(user);
  user.run_quickly("take-custom-view\nstep\n");
  EXPECT_GT(user.session().records.back().points, 100u);
  EXPECT_EQ(log_of(user).find("would measure nothing"), std::string::npos);
  user.run_quickly("custom-view 0.6 0 0 2 0 0\n");
  EXPECT_NE(log_of(user).find("Your view would measure nothing: it looks past the object"), std::string::npos);
}

}  // namespace
}  // namespace nextview

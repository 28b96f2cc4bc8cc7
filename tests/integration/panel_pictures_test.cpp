// Each panel in use, as the manual shows it.
#include <gtest/gtest.h>

#include "tests/integration/user.hpp"
#include "tests/render/render_test.hpp"

namespace nextview {
namespace {

/// The manual's object, with a camera that is quick to simulate.
Configuration housing() {
  Configuration c;
  c.object.file = "slotted_housing";
  c.sensor.width = 320;
  c.sensor.height = 240;
  return c;
}

/// The centre of the occupied voxel that is nearest to the viewer: nothing hides it.
Vector3 nearest_voxel(User& user) {
  const SessionSnapshot& s = user.session();
  const Vector3 viewer = user.window().scene().camera_pose().translation();
  Vector3 nearest = Vector3::Constant(1e3);
  for (std::uint32_t v = 0; v < s.voxels->size(); ++v) {
    const Vector3 centre = s.grid.centre(v);
    const bool shown = (*s.voxels)[v].voxel_class == VoxelClass::occupied;
    if (shown && (centre - viewer).norm() < (nearest - viewer).norm()) nearest = centre;
  }
  return nearest;
}

/// The group is one that whoever sets up a scan looks for first.
void show_sensor_settings(User& user) {
  user.click(70, 473);
  user.move(5, 790);
  user.wait();
}

/// What was told goes, warnings last, in one long frame: there is nothing to see of the time between.
void let_notices_go(User& user) {
  user.window().draw(13.0);
  user.wait();
}

PictureBound bound() { return {0.03, 255, "times and progress differ from run to run"}; }

TEST(PanelPictures, CandidatesThenAViewThenARayOfIt) {
  User user(housing());
  user.run_quickly("step\nstep\nstep\nselect-view 37\n");
  show_sensor_settings(user);
  expect_screenshot("panel_candidates", user.look(), bound());
  user.run("select-view 32\npanel view\npanel layers\nzoom 3\n");
  expect_screenshot("panel_view", user.look(), bound());
  user.run("inspect-ray 7712\n");
  expect_screenshot("panel_ray", user.look(), bound());
}

TEST(PanelPictures, GibbsThenAVoxelOfIt) {
  User user(housing());
  user.run_quickly("step\nstep\nstep\nrefine\npanel layers\nvoxel-colour probability\nzoom 5\n");
  const auto pixel = user.window().scene().project(nearest_voxel(user));
  user.run("voxel-map gibbs\nvoxel-colour difference\ntoggle-rays\ntoggle-cloud\n");
  let_notices_go(user);
  expect_screenshot("panel_gibbs", user.look(), bound());
  user.run("voxel-map conventional\nvoxel-colour probability\ntoggle-rays\ntoggle-cloud\n");
  user.click(pixel->x(), pixel->y());
  user.move(5, 790);
  user.wait();
  ASSERT_TRUE(user.window().state().selection.voxel) << "there is no voxel where the object is";
  expect_screenshot("panel_voxel", user.look(), bound());
}

TEST(PanelPictures, LogAndMissedSurface) {
  User user(housing());
  user.run_quickly("toggle-octree\ntoggle-cloud\ntoggle-rays\n");  // first: they need not be drawn at each step
  user.run("step\nstep\ntake-view 20\nstep\npanel log\ntoggle-missed\nzoom 4\n");
  expect_screenshot("panel_log", user.look(), bound());
}

TEST(PanelPictures, ASectionThroughTheSurface) {
  Configuration c = housing();
  c.termination.views = 6;
  c.termination.surface_left = 0.0;
  User user(c);
  user.run_quickly("play\npanel layers\ntoggle-surface\ntoggle-views\nsection-axis x\nsecond-view octree\nframe\n");
  user.run("wait until done\n");
  let_notices_go(user);
  expect_screenshot("panel_section", user.look(), bound());
  user.run("dark\n");
  expect_screenshot("window_dark", user.look(), bound());
}

TEST(PanelPictures, CurvesOfSeveralRuns) {
  Configuration c = housing();
  c.termination.views = 6;
  c.termination.surface_left = 0.0;
  User user(c);
  user.run_quickly("toggle-octree\nplay\n");  // which then need not be drawn at each step
  user.run_quickly("set planner.gain occlusion-aware\nreset\n");
  user.run_quickly("play\n");
  user.run_quickly("set planner.gain random\nreset\n");
  user.run("play\ncurves coverage gain\ncloud-colour distance\nwait until done\n");
  let_notices_go(user);
  expect_screenshot("panel_curves", user.look(), bound());
}

TEST(PanelPictures, TimelineThenAComparison) {
  Configuration c = housing();
  c.termination.surface_left = 0.0;
  User user(c);
  user.run_quickly("step\nstep\nstep\nstep\nrename-branch main \"by new surface\"\ngo-to-view 2\n");
  user.run_quickly("branch \"by entropy\"\nset planner.gain average-entropy\nstep\nstep\nstep\n");
  user.run("toggle-rays\ntoggle-region\npanel timeline\n");
  expect_screenshot("panel_timeline", user.look(), bound());
  user.run("compare \"by new surface\"\ntoggle-views\ntoggle-octree\ntoggle-missed\nframe\n");
  expect_screenshot("panel_comparison", user.look(), bound());
}

TEST(PanelPictures, Palette) {
  User user(housing());
  user.run_quickly("step\npalette\n");
  user.write("view");
  user.wait();
  expect_screenshot("palette", user.look(), bound());
}

TEST(PanelPictures, Shortcuts) {
  User user(housing());
  user.run("step\nshortcuts\n");
  expect_screenshot("shortcuts", user.look(), bound());
}

TEST(PanelPictures, HiDpi) {
  User user(housing(), 2560, 1600, 2.0);
  user.run("step\nstep\nselect-view 32\npanel view\n");
  expect_screenshot("window_hidpi", user.look(), bound());
}

}  // namespace
}  // namespace nextview

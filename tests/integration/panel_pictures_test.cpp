// Each panel in use, as the README shows it.
#include <gtest/gtest.h>

#include "tests/integration/person.hpp"
#include "tests/render/render_test.hpp"

namespace nextview {
namespace {

/// The README's object, with a camera that is quick to simulate.
Configuration housing() {
  Configuration c;
  c.object.file = "slotted_housing";
  c.sensor.width = 320;
  c.sensor.height = 240;
  return c;
}

/// The centre of the occupied voxel that is nearest to the viewer: nothing hides it.
Vector3 nearest_voxel(Person& person) {
  const SessionSnapshot& s = person.session();
  const Vector3 viewer = person.window().scene().camera_pose().translation();
  Vector3 nearest = Vector3::Constant(1e3);
  for (std::uint32_t v = 0; v < s.voxels->size(); ++v) {
    const Vector3 centre = s.grid.centre(v);
    const bool shown = (*s.voxels)[v].voxel_class == VoxelClass::occupied;
    if (shown && (centre - viewer).norm() < (nearest - viewer).norm()) nearest = centre;
  }
  return nearest;
}

PictureBound bound() { return {0.03, 255, "times and progress differ from run to run"}; }

TEST(PanelPictures, Candidates) {
  Person person(housing());
  person.run("step\nstep\nstep\nselect-view 12\n");
  expect_screenshot("panel_candidates", person.look(), bound());
}

TEST(PanelPictures, View) {
  Person person(housing());
  person.run("step\nstep\nstep\nselect-view 32\npanel view\npanel layers\nzoom 3\n");
  expect_screenshot("panel_view", person.look(), bound());
}

TEST(PanelPictures, InspectorOfARay) {
  Person person(housing());
  person.run("step\nstep\nstep\nselect-view 32\ninspect-ray 470\npanel layers\nzoom 3\n");
  expect_screenshot("panel_ray", person.look(), bound());
}

TEST(PanelPictures, InspectorOfAVoxel) {
  Person person(housing());
  person.run("step\nstep\nstep\nrefine\npanel layers\nvoxel-colour probability\nzoom 5\n");
  const auto pixel = person.window().scene().project(nearest_voxel(person));
  person.click(pixel->x(), pixel->y());
  person.move(5, 790);
  person.wait();
  ASSERT_TRUE(person.window().state().selection.voxel) << "there is no voxel where the object is";
  expect_screenshot("panel_voxel", person.look(), bound());
}

TEST(PanelPictures, Gibbs) {
  Person person(housing());
  person.run(
      "step\nstep\nstep\nrefine\nvoxel-map gibbs\nvoxel-colour difference\npanel "
      "layers\ntoggle-rays\ntoggle-cloud\nzoom 5\n");
  expect_screenshot("panel_gibbs", person.look(), bound());
}

TEST(PanelPictures, LogAndMissedSurface) {
  Person person(housing());
  person.run(
      "step\nstep\ntake-view 20\nstep\npanel log\ntoggle-octree\ntoggle-cloud\ntoggle-missed\ntoggle-rays\nzoom 4\n");
  expect_screenshot("panel_log", person.look(), bound());
}

TEST(PanelPictures, CurvesOfSeveralRuns) {
  Configuration c = housing();
  c.termination.views = 6;
  Person person(c);
  person.run("play\n");
  person.run("set planner.gain average-entropy\n");
  person.run("play\n");
  person.run("set planner.gain random\n");
  person.run("play\ncurves coverage gain\ncloud-colour distance\ntoggle-octree\n");
  expect_screenshot("panel_curves", person.look(), bound());
}

TEST(PanelPictures, Palette) {
  Person person(housing());
  person.run("step\npalette\n");
  person.write("view");
  person.wait();
  expect_screenshot("palette", person.look(), bound());
}

TEST(PanelPictures, Shortcuts) {
  Person person(housing());
  person.run("step\nshortcuts\n");
  expect_screenshot("shortcuts", person.look(), bound());
}

TEST(PanelPictures, HiDpi) {
  Person person(housing(), 2560, 1600, 2.0);
  person.run("step\nstep\nselect-view 32\npanel view\n");
  expect_screenshot("window_hidpi", person.look(), bound());
}

}  // namespace
}  // namespace nextview

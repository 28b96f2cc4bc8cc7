// Ways to the same session must show the same window. These need no stored picture, and so none can be wrong.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/file/atomic_file.hpp"
#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/render/picture_comparison.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"

namespace nextview {
namespace {

/// Two views, and all that can be switched on.
constexpr const char* lines = "step\nstep\ntoggle-region\ntoggle-candidates\nvoxel-colour probability\nselect-view 3\n";

/// The window, or the scene alone (of what is opened, the log and the buttons differ).
Image look(User& user, bool scene_alone) {
  if (scene_alone) user.run("hide-panels\n");
  user.run("look-from 20 30\n");
  user.window().draw(60.0);  // at rest, and what was told has gone
  user.wait();
  return user.look();
}

class SameWindow : public InTemporaryFolder {
 protected:
  static Image after(const std::string& script, bool scene_alone = false) {
    User user(tiny_scan(), half_width, half_height, half_scale);
    user.run_quickly(script);
    return look(user, scene_alone);
  }
};

/// All but the status line, which says how long the step took.
TEST_F(SameWindow, OnOneThreadAndOnAll) {
  constexpr int status_line = 20;  // [px] no less than its height
  const auto above_status_line = [](Image picture) {
    picture.height -= status_line;
    picture.rgba.resize(std::size_t(picture.width) * std::size_t(picture.height) * 4);
    return picture;
  };
  const Image all = above_status_line(after(lines));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Image single = above_status_line(after(lines));
  EXPECT_TRUE(all == single) << compare(all, single).summary();
}

TEST_F(SameWindow, StepByStepAndLoadedFromItsFolder) {
  const std::string kept = (folder_ / "kept").string();
  const Image stepped = after(fmt::format("{}export \"{}\"\n", lines, kept), true);
  const Image loaded = after(fmt::format("open \"{}\"\ntoggle-region\ntoggle-candidates\nvoxel-colour probability\n"
                                         "select-view 3\n",
                                         kept),
                             true);
  EXPECT_TRUE(compare(stepped, loaded).within({})) << compare(stepped, loaded).summary();
  EXPECT_FALSE(compare(stepped, after("step\n", true)).within({})) << "nothing is seen of what was done";
}

TEST_F(SameWindow, BackAndForthAndStraight) {
  const Image straight = after(lines, true);
  const Image detour = after(
      "step\nstep\nstep\nundo\nprevious-view\nnext-view\ntoggle-region\ntoggle-region\n"
      "toggle-region\ntoggle-candidates\nvoxel-colour entropy\nvoxel-colour probability\n"
      "select-view 5\nselect-view 3\n",
      true);
  EXPECT_TRUE(compare(straight, detour).within({})) << compare(straight, detour).summary();
}

/// With all that is in the graphics card's memory: letters, pictures of views, voxels, points, meshes and their coarse
/// twins, a surface, a section and its hatching, a second scene.
TEST_F(SameWindow, AfterTheGraphicsCardWasReset) {
  for (const char* shown : {"panel view\nobject-style solid\n", "toggle-object\ntoggle-surface\nsection-axis x\ndark\n",
                            "panel candidates\nsecond-view octree\ntoggle-missed\n", "panel curves\ntoggle-octree\n"}) {
    User user(tiny_scan(), half_width, half_height, half_scale);
    user.run_quickly(fmt::format("{}{}wait until done\n", lines, shown));
    const Image before = look(user, false);
    user.window().renew_target();
    const Image after = look(user, false);
    EXPECT_TRUE(before == after) << shown << compare(before, after).summary();
    EXPECT_EQ(user.target().gl_error(), 0u) << shown;
    user.run_quickly("turn 30 0\nstep\nturn -30 0\nundo\n");  // with what is made for motion alone
    const Image later = look(user, true);
    User other(tiny_scan(), half_width, half_height, half_scale);
    other.run_quickly(fmt::format("{}{}wait until done\nturn 30 0\nstep\nturn -30 0\nundo\n", lines, shown));
    const Image never_lost = look(other, true);
    EXPECT_TRUE(later == never_lost) << shown << compare(later, never_lost).summary();
  }
}

}  // namespace
}  // namespace nextview

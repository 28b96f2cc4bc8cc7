// The timeline and the comparison, by hand, and what a person is asked.
#include <gmock/gmock.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/integration/window_pixels.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/scanner_commands.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;

class WindowBranches : public testing::Test {
 protected:
  std::string question() { return user_.window().question(); }
  std::size_t views() { return user_.session().records.size(); }
  Rectangle bottom() { return user_.window().layout().bottom; }
  /// Where the timeline shows a view: as drawn on a display that does not scale.
  Point cell(std::size_t row, std::size_t view) {
    return {bottom().x + 14 + 158 + 20 + double(view - 1) * 66 + 30, bottom().y + 32 + 12 + double(row) * 73 + 22};
  }
  User user_{small_scan()};
};

TEST_F(WindowBranches, AClickOnAViewGoesThereAndADragAlong) {
  user_.run_quickly("step\nstep\nstep\npanel timeline\n");
  const Point second = cell(0, 2);
  user_.click(second.x, second.y);
  user_.wait_for_news();
  EXPECT_EQ(views(), 2u);
  user_.move(second.x, second.y);
  user_.press();
  user_.wait_for_news();
  for (const std::size_t view : {1u, 2u, 3u}) {
    user_.move(cell(0, view).x, cell(0, view).y);
    user_.wait_for_news();
    EXPECT_EQ(views(), view);
  }
  user_.release();
  user_.wait_for_news();
  user_.type(Key::page_up);
  user_.wait_for_news();
  EXPECT_EQ(views(), 2u);
  user_.run_quickly("step\n");
  EXPECT_EQ(user_.session().timeline->branches.all.size(), 2u);
  user_.click(cell(0, 3).x, cell(0, 3).y);
  user_.wait_for_news();
  EXPECT_EQ(user_.session().timeline->branches.current().name, "main") << "a click on another row goes to its branch";
  EXPECT_EQ(views(), 3u);
}

TEST_F(WindowBranches, SpaceStepsAfterPageUpWhateverPanelHasTheFocus) {
  user_.run_quickly("step\nstep\npanel timeline\n");
  user_.click(bottom().x + bottom().width - 20, bottom().y + bottom().height - 20);  // where nothing is, in the panel
  user_.wait_for_news();
  user_.type(Key::page_up);
  user_.wait_for_news();
  EXPECT_EQ(views(), 1u);
  user_.type(Key::space);
  user_.wait_for_news();
  EXPECT_EQ(views(), 2u) << "no item of the panel was pressed instead";
  EXPECT_EQ(user_.session().timeline->branches.all.size(), 2u);
}

TEST_F(WindowBranches, TheComparedOneTakesHalfOfTheSceneAndMovesWithIt) {
  user_.run_quickly("step\nstep\nbranch other\nstep\n");
  const Rectangle scene = user_.window().layout().scene;
  EXPECT_EQ(user_.window().scene().rectangle(), scene);
  user_.run("compare main\n");
  EXPECT_EQ(user_.window().scene().rectangle().width, std::floor(scene.width / 2));
  const Rectangle right{scene.x + scene.width / 2, scene.y, scene.width / 2, scene.height};
  const auto amber = [&] { return count_amber(user_.look(), right); };
  const int before = amber();
  EXPECT_GT(before, 0) << "its voxels are seen";
  const Pose camera = user_.window().scene().camera_pose();
  user_.move(right.x + right.width / 2, right.y + right.height / 2);
  user_.press();
  user_.wait();
  user_.move(right.x + right.width / 2 + 80, right.y + right.height / 2 + 20);
  user_.wait();
  user_.release();
  user_.wait();
  EXPECT_FALSE(user_.window().scene().camera_pose().isApprox(camera)) << "a drag there turns both";
  EXPECT_EQ(user_.target().window().GetMultiSamples(), RenderTarget::smooth_samples) << "edges stay rough";
  user_.run("toggle-octree\n");
  EXPECT_LT(amber(), before / 2) << "layers are those of both";
  user_.run("toggle-octree\nstop-comparing\n");
  EXPECT_EQ(user_.window().scene().rectangle(), scene);
  EXPECT_EQ(user_.target().gl_error(), 0u);
}

TEST_F(WindowBranches, TheObjectIsSeenWholeWhereTheSceneGetsNarrower) {
  user_.run_quickly("step\nstep\nbranch other\nstep\n");
  SceneView& scene = user_.window().scene();
  const Rectangle place = scene.rectangle();
  user_.run_quickly("turn 30 10\n");  // framed no more
  const auto is_whole = [&] {
    const auto& vertices = user_.session().mesh->vertices;
    return std::ranges::all_of(vertices, [&](const Eigen::Vector3f& vertex) {
      const auto pixel = scene.project(vertex.cast<double>());
      return pixel && scene.rectangle().contains(pixel->x(), pixel->y());
    });
  };
  ASSERT_TRUE(is_whole());
  user_.run_quickly("compare main\n");
  EXPECT_LT(scene.rectangle().width, place.width);
  EXPECT_TRUE(is_whole());
}

/// It would be made of one of the two only.
TEST_F(WindowBranches, TheReconstructedSurfaceIsNotCompared) {
  user_.run_quickly("step\nstep\nbranch other\nstep\ntoggle-surface\ncompare main\n");
  const LayerChoice& layers = user_.window().state().layers;
  EXPECT_FALSE(layers.surface);
  EXPECT_TRUE(layers.octree);
  user_.type(key('9'));
  user_.wait_for_news();
  EXPECT_FALSE(layers.surface);
  EXPECT_THAT(user_.worker().log().entries()->back().text, HasSubstr("stop comparing first"));
  user_.run_quickly("stop-comparing\n");
  EXPECT_TRUE(layers.surface) << "it was shown before";
  EXPECT_FALSE(layers.octree);
}

TEST_F(WindowBranches, ASettingThatStartsOverAsksAPersonFirst) {
  user_.run_quickly("step\nstep\n");
  user_.window().ask(command::set("map.resolution", "0.05"));
  EXPECT_THAT(question(), HasSubstr("Voxel = 50 mm starts the scan over. Its 2 views are set aside: undo brings "
                                    "them back."));
  user_.type(Key::escape);
  user_.wait_for_news();
  EXPECT_EQ(question(), "");
  EXPECT_EQ(views(), 2u);
  user_.window().ask(command::set("map.resolution", "0.05"));
  user_.run_quickly("answer \"Start over\"\n");
  EXPECT_EQ(views(), 0u);
  user_.run_quickly("undo\n");
  EXPECT_EQ(views(), 2u);
  user_.window().ask(command::set("map.resolution", "0.01 mm"));
  user_.wait_for_news();
  EXPECT_EQ(question(), "") << "it is refused before anything is asked";
  user_.window().ask(command::set("planner.gain", "random"));
  user_.wait_for_news();
  EXPECT_EQ(question(), "") << "it keeps the scan";
  EXPECT_EQ(user_.session().configuration.planner.gain, "random");
  user_.run_quickly("previous-view\nstep\nprevious-view\nprevious-view\n");
  EXPECT_EQ(views(), 0u);
  user_.window().ask(command::set("map.resolution", "0.05"));
  EXPECT_THAT(question(), HasSubstr("Its 3 views are set aside")) << "of both branches, wherever the scan stands";
  user_.type(Key::escape);
  user_.run_quickly("set map.resolution 0.05\n");
  EXPECT_EQ(views(), 0u) << "a script is not asked";
}

TEST_F(WindowBranches, QuitAsksWhereViewsAreKeptNowhere) {
  user_.window().ask_to_quit();
  EXPECT_TRUE(user_.window().wants_to_quit()) << "nothing is lost";
  User other(small_scan());
  other.run_quickly("step\n");
  other.window().ask_to_quit();
  other.wait_for_news();
  EXPECT_FALSE(other.window().wants_to_quit());
  EXPECT_THAT(other.window().question(), HasSubstr("The view is kept nowhere"));
  other.window().ask(command::answer("Export…"));
  other.wait_for_news();
  EXPECT_EQ(other.window().state().file_for, "export") << "it is offered at once";
  other.type(Key::escape);
  other.wait_for_news();
  other.window().ask_to_quit();
  other.wait_for_news();
  other.type(Key::escape);
  other.wait_for_news();
  EXPECT_FALSE(other.window().wants_to_quit());
  other.window().ask_to_quit();
  other.window().ask_to_quit();
  EXPECT_TRUE(other.window().wants_to_quit()) << "who closes it twice means it";
}

TEST_F(WindowBranches, UndoTakesBackWhatWasDoneLast) {
  user_.run_quickly("step\nselect-view 3\nselect-view 4\n");
  const auto selected = [&] { return user_.window().state().selection.candidate(); };
  user_.run_quickly("undo\n");
  EXPECT_EQ(selected(), 3u);
  user_.run_quickly("undo\n");
  EXPECT_EQ(selected(), std::nullopt);
  user_.run_quickly("redo\nredo\n");
  EXPECT_EQ(selected(), 4u);
  EXPECT_EQ(views(), 1u);
  user_.run_quickly("undo\nundo\nundo\n");
  EXPECT_EQ(views(), 0u);
}

TEST_F(WindowBranches, ASavedScriptLeavesOutWhatFailed) {
  user_.run_quickly("step\n");
  user_.window().run_script(parse_script("open \"/no/such file.ply\"\nstep\n"));
  user_.wait_for_news();
  for (const std::string& line : user_.window().state().history.lines)
    EXPECT_EQ(line.find("no such file"), line.npos) << line;
  EXPECT_THAT(user_.window().state().history.lines, testing::Contains("step").Times(2));
}

}  // namespace
}  // namespace nextview

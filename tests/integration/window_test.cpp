// A scan in the window: by keys, clicks and files.
#include <gtest/gtest.h>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/integration/window_pixels.hpp"
#include "ui/appearance/theme.hpp"

namespace nextview {
namespace {

TEST(Window, LoadsTheObjectAndStepsByKeys) {
  User user(small_scan());
  user.wait();
  EXPECT_EQ(user.window().title(), "Nextview - sphere - view 0 of 5");
  const Image before = user.look();
  const Rectangle scene = user.window().layout().scene, curves = user.window().layout().bottom;
  EXPECT_GT(colours(before, scene), 500u) << "the object is not there";
  user.type(key('S'));
  user.type(Key::space);
  user.wait();
  EXPECT_EQ(user.session().records.size(), 2u);
  EXPECT_EQ(user.window().title(), "Nextview - sphere - view 2 of 5");
  const Image after = user.look();
  EXPECT_GT(count_amber(after, scene), count_amber(before, scene) + 1000) << "the voxels are not there";
  EXPECT_GT(count(after, curves, theme::series[0]), 100) << "the curves are not there";
  EXPECT_GT(count(after, user.window().layout().right, theme::ink), 50) << "the candidates are not there";
}

TEST(Window, PlaysUntilTheScanIsFinished) {
  User user(small_scan(), half_width, half_height, half_scale);
  user.type(key('P'));
  user.wait_for_news();
  EXPECT_EQ(user.session().records.size(), 5u);
  EXPECT_FALSE(user.session().finished.empty());
  user.type(key('S'));
  user.wait_for_news();
  EXPECT_EQ(user.session().records.size(), 5u) << "a finished scan takes no more views";
  user.type(key('R'));
  user.wait_for_news();
  EXPECT_EQ(user.session().records.size(), 5u) << "it is asked first";
  user.type(key('S'));
  user.wait_for_news();
  EXPECT_EQ(user.session().records.size(), 5u) << "nothing is done behind a question";
  user.read_question();
  user.type(Key::enter);
  user.wait_for_news();
  EXPECT_EQ(user.window().question(), "");
  EXPECT_EQ(user.session().records.size(), 5u) << "Enter alone loses nothing";
  user.type(key('R'));
  user.wait_for_news();
  user.window().ask(parse_call("answer \"Start over\""));
  user.wait_for_news();
  EXPECT_TRUE(user.session().records.empty());
}

TEST(Window, NoClickIsLost) {
  User user(small_scan());
  const Point step = step_button(user.window().layout());
  for (int i = 0; i < 3; ++i) user.click(step.x, step.y);
  user.wait_for_news();
  EXPECT_EQ(user.session().records.size(), 3u);
}

TEST(Window, DrawsTheSceneOnlyWhenItChanged) {
  User user(small_scan(), half_width, half_height, half_scale);
  user.type(key('S'));
  user.wait();
  const std::size_t drawings = user.window().scene_drawings();
  const Image drawn = user.look();
  const Rectangle left = user.window().layout().left;
  const Point start{middle(left).x, left.y + left.height - 20 * half_scale};  // where nothing answers
  user.move(start.x, start.y);
  user.wait();
  for (int i = 0; i < 5; ++i) user.window().draw(1.0 / 60);
  EXPECT_EQ(user.window().scene_drawings(), drawings);
  EXPECT_EQ(user.look(), drawn) << "the kept picture is another one";
  user.type(key('F'));
  user.wait();
  EXPECT_EQ(user.window().scene_drawings(), drawings + 2) << "at once with rough edges, then with smooth ones";
  EXPECT_EQ(user.look(), drawn) << "framing what is framed already moved the camera";
}

TEST(Window, PanelsTellOfANewMapAFrameBeforeTheScene) {
  User user(small_scan(), half_width, half_height, half_scale);
  user.wait();
  Interface& window = user.window();
  const std::size_t drawings = window.scene_drawings();
  const std::string title = window.title();
  window.ask(parse_script("step\n").front());
  while (window.title() == title) window.draw(1.0 / 60);
  EXPECT_EQ(window.scene_drawings(), drawings);
  user.wait();
  EXPECT_EQ(window.scene_drawings(), drawings + 2) << "at once with rough edges, then with smooth ones";
}

TEST(Window, TheMissedSurfaceIsTheSameWheneverItIsShown) {
  User user(small_scan(), half_width, half_height, half_scale);
  user.run("step\ntoggle-views\ntoggle-octree\ntoggle-missed\n");
  EXPECT_FALSE(user.window().scene().layers().mesh().visible()) << "the object lies in its own missed surface";
  // The panels are others after each command, whatever the scene shows.
  const Rectangle scene = user.window().layout().scene;
  const Image at_first = user.look();
  user.run("toggle-missed\ntoggle-octree\n");
  EXPECT_GT(differences(user.look(), at_first, scene), 100);
  user.run("toggle-missed\n");
  EXPECT_EQ(user.look(), at_first);
  user.run("step\nstep\n");  // one alone may see just what lies behind
  EXPECT_LT(count_amber(user.look(), scene), count_amber(at_first, scene) - 50) << "less of it is missed now";
}

TEST(Window, KeysSwitchLayers) {
  User user(small_scan(), half_width, half_height, half_scale);
  user.type(key('S'));
  user.wait();
  const Rectangle scene = user.window().layout().scene;
  const Image with = user.look();
  user.type(key('3'));  // octree
  user.wait();
  EXPECT_LT(count_amber(user.look(), scene), count_amber(with, scene) / 2);
  user.type(key('3'));
  user.wait();
  EXPECT_EQ(user.look(), with);
}

TEST(Window, ABadFileIsAMessageAndTheSessionStays) {
  User user(small_scan());
  user.type(key('S'));
  user.wait();
  const Rectangle status = user.window().layout().status;
  EXPECT_EQ(count(user.look(), status, theme::chosen), 0);
  user.drop("/no/such/file.ply");
  user.wait();
  EXPECT_NE(user.session().message.find("/no/such/file.ply"), std::string::npos) << user.session().message;
  EXPECT_EQ(user.session().records.size(), 1u);
  EXPECT_GT(count(user.look(), status, theme::chosen), 20) << "the message is not shown";
  user.type(key('S'));
  user.wait();
  EXPECT_TRUE(user.session().message.empty()) << "the message stays after a step that worked";
  EXPECT_EQ(user.session().records.size(), 2u);
}

TEST(Window, ADroppedObjectIsLoaded) {
  User user(small_scan(), half_width, half_height, half_scale);
  user.drop(assets_folder() / "objects" / "box.ply");
  user.wait_for_news();
  EXPECT_EQ(user.session().object_name, "box");
  EXPECT_EQ(user.session().configuration.views.count, 12) << "the other settings stay";
}

TEST(Window, APersonCanTakeAnotherView) {
  User user(small_scan());
  user.type(key('S'));
  user.wait_for_news();
  const Layout layout = user.window().layout();
  const Point row = table_row(layout, 3), take = take_button(layout);
  const auto proposal = user.session().proposal();
  ASSERT_EQ(user.session().next_candidate, proposal);
  user.click(row.x, row.y);
  user.click(take.x, take.y);
  user.wait_for_news();
  const auto chosen = user.session().next_candidate;
  EXPECT_NE(chosen, proposal);
  EXPECT_EQ(user.session().proposal(), proposal);
  user.type(key('S'));
  user.wait_for_news();
  EXPECT_TRUE(user.session().records.back().overridden);
  EXPECT_EQ(user.session().records.back().view, int(chosen.value()));
}

TEST(Window, ControlQQuits) {
  User user(small_scan(), half_width, half_height, half_scale);
  user.type(key('Q'));
  user.wait_for_news();
  EXPECT_FALSE(user.window().wants_to_quit());
  user.window().push(input::KeyChange{Key::control, true});
  user.type(key('Q'));
  user.wait_for_news();
  EXPECT_TRUE(user.window().wants_to_quit());
}

}  // namespace
}  // namespace nextview

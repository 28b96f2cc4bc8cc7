#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/file/atomic_file.hpp"
#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "ui/appearance/theme.hpp"

namespace nextview {
namespace {

struct Point {
  double x, y;
};

Point step_button(const Layout& layout) { return {50, layout.control_bar.y + layout.control_bar.height / 2}; }
Point table_row(const Layout& layout, int row) { return {layout.right.x + 100, layout.right.y + 106 + 21 * row}; }
Point take_button(const Layout& layout) { return {layout.right.x + 80, layout.right.y + layout.right.height - 24}; }
Point middle(const Rectangle& r) { return {r.x + r.width / 2, r.y + r.height / 2}; }

int count(const Image& image, const Rectangle& r, const std::function<bool(const std::uint8_t*)>& matches) {
  int result = 0;
  for (int y = int(r.y); y < int(r.y + r.height); ++y) {
    for (int x = int(r.x); x < int(r.x + r.width); ++x)
      result += matches(&image.rgba[(std::size_t(y) * image.width + x) * 4]);
  }
  return result;
}

/// Pixels of exactly this colour.
int count(const Image& image, const Rectangle& r, const Colour& colour) {
  return count(image, r, [&](const std::uint8_t* pixel) {
    for (int i = 0; i < 3; ++i) {
      if (std::abs(pixel[i] - colour[i] * 255) > 1.0) return false;
    }
    return true;
  });
}

/// Shades of blue as occupied voxels have them in the scene's light.
int count_blue(const Image& image, const Rectangle& r) {
  return count(image, r, [](const std::uint8_t* p) { return p[2] > p[0] + 40 && p[2] > p[1] + 15; });
}

std::size_t colours(const Image& image, const Rectangle& r) {
  std::set<std::uint32_t> seen;
  count(image, r, [&](const std::uint8_t* p) { return seen.insert(p[0] << 16 | p[1] << 8 | p[2]).second; });
  return seen.size();
}

TEST(Window, LoadsTheObjectAndStepsByKeys) {
  User user(small_scan());
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
  EXPECT_GT(count_blue(after, scene), count_blue(before, scene) + 1000) << "occupied voxels are not there";
  EXPECT_GT(count(after, curves, theme::series[0]), 100) << "the curves are not there";
  EXPECT_GT(count(after, user.window().layout().right, theme::ink), 50) << "the candidates are not there";
}

TEST(Window, PlaysUntilTheScanIsFinished) {
  User user(small_scan());
  user.type(key('P'));
  user.wait();
  EXPECT_EQ(user.session().records.size(), 5u);
  EXPECT_FALSE(user.session().finished.empty());
  user.type(key('S'));
  user.wait();
  EXPECT_EQ(user.session().records.size(), 5u) << "a finished scan takes no more views";
  user.type(key('R'));
  user.wait();
  EXPECT_TRUE(user.session().records.empty());
}

TEST(Window, NoClickIsLost) {
  User user(small_scan());
  const Point step = step_button(user.window().layout());
  for (int i = 0; i < 3; ++i) user.click(step.x, step.y);
  user.wait();
  EXPECT_EQ(user.session().records.size(), 3u);
}

TEST(Window, DrawsTheSceneOnlyWhenItChanged) {
  User user(small_scan());
  user.type(key('S'));
  user.wait();
  const std::size_t drawings = user.window().scene_drawings();
  const Image drawn = user.look();
  const Rectangle left = user.window().layout().left;
  const Point start{middle(left).x, left.y + left.height - 20};  // where nothing answers
  user.move(start.x, start.y);
  user.wait();
  for (int i = 0; i < 5; ++i) user.window().draw(1.0 / 60);
  EXPECT_EQ(user.window().scene_drawings(), drawings);
  EXPECT_EQ(user.look(), drawn) << "the kept picture is another one";
  user.type(key('F'));
  user.wait();
  EXPECT_EQ(user.window().scene_drawings(), drawings + 1);
  EXPECT_EQ(user.look(), drawn) << "framing what is framed already moved the camera";
}

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
  EXPECT_NE(user.look(), on_panel);
  EXPECT_TRUE(user.session().records.empty()) << "the release pressed a button";
}

TEST(Window, ADragThatBeganOnAPanelLeavesTheCameraAlone) {
  User user(small_scan());
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

TEST(Window, KeysSwitchLayers) {
  User user(small_scan());
  user.type(key('S'));
  user.type(key('4'));  // candidate views, some of which are blue as well
  user.wait();
  const Rectangle scene = user.window().layout().scene;
  const Image with = user.look();
  user.type(key('3'));  // octree
  user.type(key('2'));  // cloud
  user.wait();
  EXPECT_LT(count_blue(user.look(), scene), count_blue(with, scene) / 2);
  user.type(key('3'));
  user.type(key('2'));
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
  User user(small_scan());
  user.drop(assets_folder() / "objects" / "box.ply");
  user.wait();
  EXPECT_EQ(user.session().object_name, "box");
  EXPECT_EQ(user.session().configuration.views.count, 12) << "the other settings stay";
}

TEST(Window, APersonCanTakeAnotherView) {
  User user(small_scan());
  user.type(key('S'));
  user.wait();
  const Layout layout = user.window().layout();
  const Point row = table_row(layout, 3), take = take_button(layout);
  const auto proposal = user.session().proposal();
  ASSERT_EQ(user.session().next_candidate, proposal);
  user.click(row.x, row.y);
  user.click(take.x, take.y);
  user.wait();
  const auto chosen = user.session().next_candidate;
  EXPECT_NE(chosen, proposal);
  EXPECT_EQ(user.session().proposal(), proposal);
  user.type(key('S'));
  user.wait();
  EXPECT_TRUE(user.session().records.back().overridden);
  EXPECT_EQ(user.session().records.back().view, int(chosen.value()));
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

TEST(Window, ControlQQuits) {
  User user(small_scan());
  user.type(key('Q'));
  user.wait();
  EXPECT_FALSE(user.window().wants_to_quit());
  user.window().push(input::KeyChange{Key::control, true});
  user.type(key('Q'));
  user.wait();
  EXPECT_TRUE(user.window().wants_to_quit());
}

std::string bytes_of(const std::filesystem::path& file) { return read_file(file); }

/// What the window's script says, in a folder of its own.
class WindowFiles : public InTemporaryFolder {
 protected:
  std::string file(const char* name) const { return (folder_ / name).string(); }
};

TEST_F(WindowFiles, APictureIsWithoutWhatIsInFront) {
  User user(small_scan());
  user.run("step\nsave-picture " + file("plain.png") + "\n");  // leaves a notice
  const Layout layout = user.window().layout();
  const Image before = user.look();
  user.run("palette\n");
  user.write("view");
  user.wait();
  ASSERT_NE(user.look(), before);
  user.run("save-picture " + file("palette.png") + "\n");
  user.run("palette\nshortcuts\nsave-picture " + file("sheet.png") + "\nshortcuts\n");
  user.click(20, layout.menu.height / 2);
  user.wait();
  user.move(640, 5);  // off the menu's button
  user.wait();
  user.run("save-picture " + file("menu.png") + "\n");
  for (const char* other : {"palette.png", "sheet.png"})
    EXPECT_EQ(bytes_of(file(other)), bytes_of(file("plain.png"))) << other;
  EXPECT_GT(std::filesystem::file_size(file("menu.png")), 10'000u);
}

TEST_F(WindowFiles, LinesOfAScriptThatFailAreToldAndTheOthersDone) {
  User user(small_scan());
  std::vector<std::string> failures;
  user.window().script().set_on_failure(
      [&](const ScriptFailure& f) { failures.push_back(std::to_string(f.line) + " " + f.reason); });
  user.run("step\n\nexport /proc/no/such\nopen /no/such/file.ply\n# a comment\ntake-view 999\nstep\nsave-picture " +
           file("no/picture.png") + "\nsave-script /proc/no/script\nundo\nset sensor.max_range -1\nstep\n");
  ASSERT_EQ(failures.size(), 6u) << testing::PrintToString(failures);
  EXPECT_EQ(failures[0].substr(0, 10), "3 export: ");
  EXPECT_EQ(failures[1].substr(0, 8), "4 open: ");
  EXPECT_NE(failures[1].find("/no/such/file.ply"), std::string::npos) << failures[1];
  EXPECT_EQ(failures[2], "6 take-view: view 999 is not available");
  EXPECT_EQ(failures[3].substr(0, 16), "8 save-picture: ");
  EXPECT_EQ(failures[4].substr(0, 14), "9 save-script:");
  EXPECT_EQ(failures[5].substr(0, 7), "11 set:");
  EXPECT_EQ(user.session().records.size(), 2u);
  EXPECT_TRUE(user.window().script_is_done());
}

TEST(Window, AScriptThatEndsTooEarlyHasFailed) {
  User user(small_scan());
  std::vector<int> lines;
  user.window().script().set_on_failure([&](const ScriptFailure& f) { lines.push_back(f.line); });
  user.window().run_script(parse_script("step\nstep\n\nstep\n"));
  user.window().draw(1.0 / 60);
  user.window().draw(1.0 / 60);
  user.window().script().give_up("the window was closed");
  EXPECT_FALSE(lines.empty());
  EXPECT_LE(lines.size(), 2u);
  EXPECT_TRUE(user.window().script_is_done());
  user.wait();
}

/// As the window does between events: it sleeps until the next frame would be another one.
void rest(User& user) {
  for (int frames = 0; frames < 100; ++frames) {
    const double seconds = user.window().seconds_to_next_frame();
    if (std::isinf(seconds)) return;
    user.window().draw(seconds + 1e-3);
  }
}

/// How many pixels of a part differ.
int differences(const Image& a, const Image& b, const Rectangle& r) {
  int result = 0;
  for (int y = int(r.y); y < int(r.y + r.height); ++y)
    for (int x = int(r.x); x < int(r.x + r.width); ++x)
      for (int c = 0; c < 3; ++c) {
        const std::size_t at = (std::size_t(y) * a.width + x) * 4 + c;
        if (a.rgba[at] == b.rgba[at]) continue;
        ++result;
        break;
      }
  return result;
}

TEST(Window, ATooltipAppearsBesideAPointerThatRests) {
  User user(small_scan());
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
  EXPECT_NE(user.look(), through);
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
  user.run("step\nzoom -4\ncustom-view\n");
  EXPECT_NE(log_of(user).find("Your view is moved"), std::string::npos) << log_of(user);
  user.run("take-custom-view\nstep\n");
  EXPECT_GT(user.session().records.back().points, 100u);
  EXPECT_EQ(log_of(user).find("would measure nothing"), std::string::npos);
  user.run("custom-view 0.6 0 0 2 0 0\n");
  EXPECT_NE(log_of(user).find("Your view would measure nothing: it looks past the object"), std::string::npos);
}

/// Small windows fold their panels; nothing ends the program, and each panel can be reached.
TEST(Window, WorksAtAnySize) {
  for (const auto& [width, height, scale] : {std::tuple{640, 480, 1.0},
                                             {200, 150, 1.0},
                                             {300, 720, 1.0},
                                             {1400, 200, 1.0},
                                             {640, 480, 2.0},
                                             {8, 8, 1.0},
                                             {1, 1, 1.0}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    User user(small_scan(), width, height, scale);
    user.run("step\ncustom-view\nlook-through\nframe\n");
    for (const std::string_view panel : panel_names()) user.run("panel " + std::string(panel) + "\n");
    user.run("inspect-voxel 0 0 0\nshortcuts\nshortcuts\npalette\npalette\nlook-from 30 20\nzoom 1\nundo\nstep\n");
    user.move(width / 2.0, height / 2.0);
    user.press();
    user.move(width / 2.0 + 3, height / 2.0 + 2);
    user.release();
    user.wait();
    EXPECT_EQ(user.session().records.size(), 1u);
    EXPECT_EQ(user.target().gl_error(), 0u);
  }
}

TEST(Window, PanelsNeverOverlap) {
  for (const auto& [width, height, scale, open] : {std::tuple{1200, 720, 1.0, Side::right},
                                                   {1280, 800, 1.0, Side::left},
                                                   {2560, 1600, 2.0, Side::right},
                                                   {3840, 2160, 1.5, Side::right},
                                                   {640, 480, 1.0, Side::right},
                                                   {640, 480, 1.0, Side::left},
                                                   {640, 480, 1.0, Side::bottom},
                                                   {640, 480, 2.0, Side::left},
                                                   {1000, 480, 1.0, Side::bottom},
                                                   {800, 900, 1.0, Side::left},
                                                   {480, 360, 1.0, Side::bottom},
                                                   {200, 150, 1.0, Side::left},
                                                   {200, 150, 2.0, Side::right},
                                                   {40, 30, 1.0, Side::right},
                                                   {1, 1, 1.0, Side::right}}) {
    const Layout l(width, height, scale, open);
    std::vector<Rectangle> all{l.menu, l.control_bar, l.left, l.right, l.bottom, l.scene, l.status};
    std::erase_if(all, [](const Rectangle& r) { return r.empty(); });
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_GE(all[i].x, 0.0);
      EXPECT_GE(all[i].y, 0.0);
      EXPECT_LE(all[i].x + all[i].width, width);
      EXPECT_LE(all[i].y + all[i].height, height);
      for (std::size_t j = 0; j < i; ++j) {
        const bool apart = all[i].x >= all[j].x + all[j].width || all[j].x >= all[i].x + all[i].width ||
                           all[i].y >= all[j].y + all[j].height || all[j].y >= all[i].y + all[i].height;
        EXPECT_TRUE(apart) << i << " and " << j << " at " << width << " x " << height;
      }
    }
  }
}

}  // namespace
}  // namespace nextview

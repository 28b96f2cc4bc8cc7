#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/file/atomic_file.hpp"
#include "tests/integration/person.hpp"
#include "tests/integration/small_scan.hpp"
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
  Person person(small_scan());
  EXPECT_EQ(person.window().title(), "Nextview - sphere - view 0 of 5");
  const Image before = person.look();
  const Rectangle scene = person.window().layout().scene, curves = person.window().layout().bottom;
  EXPECT_GT(colours(before, scene), 500u) << "the object is not there";
  person.type(key('S'));
  person.type(Key::space);
  person.wait();
  EXPECT_EQ(person.session().records.size(), 2u);
  EXPECT_EQ(person.window().title(), "Nextview - sphere - view 2 of 5");
  const Image after = person.look();
  EXPECT_GT(count_blue(after, scene), count_blue(before, scene) + 1000) << "occupied voxels are not there";
  EXPECT_GT(count(after, curves, theme::series[0]), 100) << "the curves are not there";
  EXPECT_GT(count(after, person.window().layout().right, theme::ink), 50) << "the candidates are not there";
}

TEST(Window, PlaysUntilTheScanIsFinished) {
  Person person(small_scan());
  person.type(key('P'));
  person.wait();
  EXPECT_EQ(person.session().records.size(), 5u);
  EXPECT_FALSE(person.session().finished.empty());
  person.type(key('S'));
  person.wait();
  EXPECT_EQ(person.session().records.size(), 5u) << "a finished scan takes no more views";
  person.type(key('R'));
  person.wait();
  EXPECT_TRUE(person.session().records.empty());
}

TEST(Window, NoClickIsLost) {
  Person person(small_scan());
  const Point step = step_button(person.window().layout());
  for (int i = 0; i < 3; ++i) person.click(step.x, step.y);
  person.wait();
  EXPECT_EQ(person.session().records.size(), 3u);
}

TEST(Window, DrawsTheSceneOnlyWhenItChanged) {
  Person person(small_scan());
  person.type(key('S'));
  person.wait();
  const std::size_t drawings = person.window().scene_drawings();
  const Image drawn = person.look();
  const Rectangle left = person.window().layout().left;
  const Point start{middle(left).x, left.y + left.height - 20};  // where nothing answers
  person.move(start.x, start.y);
  person.wait();
  for (int i = 0; i < 5; ++i) person.window().draw(1.0 / 60);
  EXPECT_EQ(person.window().scene_drawings(), drawings);
  EXPECT_EQ(person.look(), drawn) << "the kept picture is another one";
  person.type(key('F'));
  person.wait();
  EXPECT_EQ(person.window().scene_drawings(), drawings + 1);
  EXPECT_EQ(person.look(), drawn) << "framing what is framed already moved the camera";
}

TEST(Window, ADragThatBeganInTheSceneGoesOnOverPanels) {
  Person person(small_scan());
  const Layout layout = person.window().layout();
  const Point in_scene{layout.scene.x + 40, layout.scene.y + 200}, step = step_button(layout);
  person.move(in_scene.x, in_scene.y);
  person.press();
  person.move(step.x + 1, step.y);
  person.wait();
  const std::size_t drawings = person.window().scene_drawings();
  const Image on_panel = person.look();
  person.move(step.x + 30, step.y + 5);
  person.release();
  person.wait();
  EXPECT_GT(person.window().scene_drawings(), drawings);
  EXPECT_NE(person.look(), on_panel);
  EXPECT_TRUE(person.session().records.empty()) << "the release pressed a button";
}

TEST(Window, ADragThatBeganOnAPanelLeavesTheCameraAlone) {
  Person person(small_scan());
  const Layout layout = person.window().layout();
  const Point panel = middle(layout.left), scene = middle(layout.scene);
  const std::size_t drawings = person.window().scene_drawings();
  person.move(panel.x, layout.left.y + layout.left.height - 8);
  person.press();
  person.move(scene.x, scene.y);
  person.release();
  person.wait();
  EXPECT_EQ(person.window().scene_drawings(), drawings);
}

TEST(Window, KeysSwitchLayers) {
  Person person(small_scan());
  person.type(key('S'));
  person.type(key('4'));  // candidate views, some of which are blue as well
  person.wait();
  const Rectangle scene = person.window().layout().scene;
  const Image with = person.look();
  person.type(key('3'));  // octree
  person.type(key('2'));  // cloud
  person.wait();
  EXPECT_LT(count_blue(person.look(), scene), count_blue(with, scene) / 2);
  person.type(key('3'));
  person.type(key('2'));
  person.wait();
  EXPECT_EQ(person.look(), with);
}

TEST(Window, ABadFileIsAMessageAndTheSessionStays) {
  Person person(small_scan());
  person.type(key('S'));
  person.wait();
  const Rectangle status = person.window().layout().status;
  EXPECT_EQ(count(person.look(), status, theme::chosen), 0);
  person.drop("/no/such/file.ply");
  person.wait();
  EXPECT_NE(person.session().message.find("/no/such/file.ply"), std::string::npos) << person.session().message;
  EXPECT_EQ(person.session().records.size(), 1u);
  EXPECT_GT(count(person.look(), status, theme::chosen), 20) << "the message is not shown";
  person.type(key('S'));
  person.wait();
  EXPECT_TRUE(person.session().message.empty()) << "the message stays after a step that worked";
  EXPECT_EQ(person.session().records.size(), 2u);
}

TEST(Window, ADroppedObjectIsLoaded) {
  Person person(small_scan());
  person.drop(assets_folder() / "objects" / "box.ply");
  person.wait();
  EXPECT_EQ(person.session().object_name, "box");
  EXPECT_EQ(person.session().configuration.views.count, 12) << "the other settings stay";
}

TEST(Window, APersonCanTakeAnotherView) {
  Person person(small_scan());
  person.type(key('S'));
  person.wait();
  const Layout layout = person.window().layout();
  const Point row = table_row(layout, 3), take = take_button(layout);
  const auto proposal = person.session().proposal();
  ASSERT_EQ(person.session().next_candidate, proposal);
  person.click(row.x, row.y);
  person.click(take.x, take.y);
  person.wait();
  const auto chosen = person.session().next_candidate;
  EXPECT_NE(chosen, proposal);
  EXPECT_EQ(person.session().proposal(), proposal);
  person.type(key('S'));
  person.wait();
  EXPECT_TRUE(person.session().records.back().overridden);
  EXPECT_EQ(person.session().records.back().view, int(chosen.value()));
}

TEST(Window, WhereAVoxelIsDrawnAClickInspectsIt) {
  Configuration configuration = small_scan();
  configuration.planner.gain = "occlusion-aware";  // goes to the nearest view: what both saw is occupied
  configuration.planner.weights = {1.0, 1.0};
  Person person(configuration);
  person.run("step\nstep\ntoggle-views\ntoggle-rays\ntoggle-cloud\ntoggle-object\n");
  const Rectangle scene = person.window().layout().scene;
  const Image image = person.look();
  int blue = 0, voxels = 0, occupied = 0;
  for (double y = scene.y + 5; y < scene.y + scene.height - 5; y += 7)
    for (double x = scene.x + 5; x < scene.x + scene.width - 5; x += 7) {
      if (count_blue(image, {x - 3, y - 3, 7, 7}) < 49) continue;
      ++blue;
      const auto picked = person.window().scene().pick(x, y);
      voxels += picked.voxel.has_value();
      if (voxels == 3) {
        person.click(x, y);
        person.wait();
        EXPECT_EQ(person.window().state().selection.voxel, picked.voxel) << "the click did not inspect it";
      }
      if (picked.voxel) occupied += (*person.session().voxels)[*picked.voxel].voxel_class == VoxelClass::occupied;
    }
  EXPECT_GT(blue, 15);
  EXPECT_GE(voxels, 0.95 * blue);
  EXPECT_GE(occupied, 0.95 * blue);
}

TEST(Window, ControlQQuits) {
  Person person(small_scan());
  person.type(key('Q'));
  person.wait();
  EXPECT_FALSE(person.window().wants_to_quit());
  person.window().push(input::KeyChange{Key::control, true});
  person.type(key('Q'));
  person.wait();
  EXPECT_TRUE(person.window().wants_to_quit());
}

std::string bytes_of(const std::filesystem::path& file) { return read_file(file); }

/// What the window's script says, in a folder of its own.
class WindowFiles : public InTemporaryFolder {
 protected:
  std::string file(const char* name) const { return (folder_ / name).string(); }
};

TEST_F(WindowFiles, APictureIsWithoutWhatIsInFront) {
  Person person(small_scan());
  person.run("step\nsave-picture " + file("plain.png") + "\n");  // leaves a notice
  const Layout layout = person.window().layout();
  const Image before = person.look();
  person.run("palette\n");
  person.write("view");
  person.wait();
  ASSERT_NE(person.look(), before);
  person.run("save-picture " + file("palette.png") + "\n");
  person.run("palette\nshortcuts\nsave-picture " + file("sheet.png") + "\nshortcuts\n");
  person.click(20, layout.menu.height / 2);
  person.wait();
  person.move(640, 5);  // off the menu's button
  person.wait();
  person.run("save-picture " + file("menu.png") + "\n");
  for (const char* other : {"palette.png", "sheet.png"})
    EXPECT_EQ(bytes_of(file(other)), bytes_of(file("plain.png"))) << other;
  EXPECT_GT(std::filesystem::file_size(file("menu.png")), 10'000u);
}

TEST_F(WindowFiles, LinesOfAScriptThatFailAreToldAndTheOthersDone) {
  Person person(small_scan());
  std::vector<std::string> failures;
  person.window().script().set_on_failure(
      [&](const ScriptFailure& f) { failures.push_back(std::to_string(f.line) + " " + f.reason); });
  person.run("step\n\nexport /proc/no/such\nopen /no/such/file.ply\n# a comment\ntake-view 999\nstep\nsave-picture " +
             file("no/picture.png") + "\nsave-script /proc/no/script\nundo\nset sensor.max_range -1\nstep\n");
  ASSERT_EQ(failures.size(), 6u) << testing::PrintToString(failures);
  EXPECT_EQ(failures[0].substr(0, 10), "3 export: ");
  EXPECT_EQ(failures[1].substr(0, 8), "4 open: ");
  EXPECT_NE(failures[1].find("/no/such/file.ply"), std::string::npos) << failures[1];
  EXPECT_EQ(failures[2], "6 take-view: view 999 is not available");
  EXPECT_EQ(failures[3].substr(0, 16), "8 save-picture: ");
  EXPECT_EQ(failures[4].substr(0, 14), "9 save-script:");
  EXPECT_EQ(failures[5].substr(0, 7), "11 set:");
  EXPECT_EQ(person.session().records.size(), 2u);
  EXPECT_TRUE(person.window().script_is_done());
}

TEST(Window, AScriptThatEndsTooEarlyHasFailed) {
  Person person(small_scan());
  std::vector<int> lines;
  person.window().script().set_on_failure([&](const ScriptFailure& f) { lines.push_back(f.line); });
  person.window().run_script(parse_script("step\nstep\n\nstep\n"));
  person.window().draw(1.0 / 60);
  person.window().draw(1.0 / 60);
  person.window().script().give_up("the window was closed");
  EXPECT_FALSE(lines.empty());
  EXPECT_LE(lines.size(), 2u);
  EXPECT_TRUE(person.window().script_is_done());
  person.wait();
}

/// As the window does between events: it sleeps until the next frame would be another one.
void rest(Person& person) {
  for (int frames = 0; frames < 100; ++frames) {
    const double seconds = person.window().seconds_to_next_frame();
    if (std::isinf(seconds)) return;
    person.window().draw(seconds + 1e-3);
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
  Person person(small_scan());
  const Layout layout = person.window().layout();
  const Image before = person.look();
  const Point step = step_button(layout), label{layout.left.x + 30, layout.left.y + 32 + 10 + 12};
  for (const Point& place : {step, label}) {
    person.move(place.x, place.y);
    person.wait();
    EXPECT_LT(differences(person.look(), before, layout.left), 100) << "it came at once";
    rest(person);
    EXPECT_GT(differences(person.look(), before, layout.left), 1000) << "no tooltip at " << place.x << ", " << place.y;
    person.move(640, 790);
    person.wait();
    rest(person);
  }
}

TEST(Window, AViewThatIsLookedThroughHidesItsOwnPyramid) {
  Person person(small_scan());
  person.run("step\nselect-next\ntoggle-region\ntoggle-rays\n");
  const Rectangle scene = person.window().layout().scene;
  const auto red = [](const std::uint8_t* p) { return p[0] > p[1] + 60 && p[0] > p[2] + 60; };
  person.run("look-through\n");
  EXPECT_LT(count(person.look(), scene, red), 0.1 * scene.width * scene.height) << "the pyramid fills the picture";
  EXPECT_GT(count_blue(person.look(), scene), 500) << "the map is not to be seen";
  const Image through = person.look();
  person.run("zoom -3\n");
  EXPECT_NE(person.look(), through);
  person.run("own-view 0.6 -0.6 0.5 0 0 0\nlook-through\n");
  EXPECT_GT(count_blue(person.look(), scene), 500) << "the map is not to be seen";
}

std::string log_of(Person& person) {
  std::string text;
  for (const LogEntry& entry : *person.worker().log().entries()) text += entry.text + "\n";
  return text;
}

TEST(Window, AViewOfOnesOwnSeesTheObject) {
  Person person(small_scan());
  person.run("step\nzoom -4\nown-view\n");
  EXPECT_NE(log_of(person).find("Your view is moved"), std::string::npos) << log_of(person);
  person.run("take-own-view\nstep\n");
  EXPECT_GT(person.session().records.back().points, 100u);
  EXPECT_EQ(log_of(person).find("would measure nothing"), std::string::npos);
  person.run("own-view 0.6 0 0 2 0 0\n");
  EXPECT_NE(log_of(person).find("Your view would measure nothing: it looks past the object"), std::string::npos);
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
    Person person(small_scan(), width, height, scale);
    person.run("step\nown-view\nlook-through\nframe\n");
    for (const std::string_view panel : panel_names()) person.run("panel " + std::string(panel) + "\n");
    person.run("inspect-voxel 0 0 0\nshortcuts\nshortcuts\npalette\npalette\nlook-from 30 20\nzoom 1\nundo\nstep\n");
    person.move(width / 2.0, height / 2.0);
    person.press();
    person.move(width / 2.0 + 3, height / 2.0 + 2);
    person.release();
    person.wait();
    EXPECT_EQ(person.session().records.size(), 1u);
    EXPECT_EQ(person.target().gl_error(), 0u);
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

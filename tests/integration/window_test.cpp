#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/integration/person.hpp"
#include "tests/integration/small_scan.hpp"
#include "ui/theme.hpp"

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
  Person person(small_scan());
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

TEST(Window, PanelsNeverOverlap) {
  for (const auto& [width, height, scale] :
       {std::tuple{1200, 720, 1.0}, {1280, 800, 1.0}, {2560, 1600, 2.0}, {3840, 2160, 1.5}}) {
    const Layout l(width, height, scale);
    const std::vector<Rectangle> all{l.menu, l.control_bar, l.left, l.right, l.bottom, l.scene, l.status};
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

// One thing of a scan, written by the window: the same as the session's own, and pictures of what is shown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/configuration_text.hpp"
#include "core/export/frame_folder.hpp"
#include "core/file/png_text.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/integration/window_pixels.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class WindowExport : public InTemporaryFolder {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  Image picture(const std::string& name) const { return read_png(file(name)); }
};

int transparent_pixels(const Image& image) {
  return count(image, {0, 0, double(image.width), double(image.height)},
               [](const std::uint8_t* pixel) { return pixel[3] == 0; });
}

TEST_F(WindowExport, FilesAreThoseOfTheWholeScan) {
  User user(small_scan());
  user.run_quickly("step\nstep\nexport " + file("whole") + "\nexport-cloud " + file("c.ply") + "\nexport-map " +
                   file("m.ot") + "\nexport-map " + file("m.bt") + "\nexport-views " + file("v.csv") +
                   "\nexport-curves " + file("s.csv") + "\nexport-surface " + file("s.stl") + " cloud all\n");
  const std::pair<const char*, const char*> pairs[] = {
      {"c.ply", "cloud.ply"}, {"m.ot", "map.ot"}, {"m.bt", "map.bt"}, {"v.csv", "views.csv"}, {"s.csv", "steps.csv"}};
  for (const auto& [one, of_all] : pairs)
    EXPECT_EQ(read_file(file(one)) == read_file(folder_ / "whole" / of_all), true) << one;
  EXPECT_EQ(fs::file_size(file("s.stl")), fs::file_size(folder_ / "whole" / "surface_cloud.stl"));
}

TEST_F(WindowExport, TheMapIsTheOneThatIsShown) {
  User user(small_scan());
  user.run_quickly("step\nstep\nexport-map " + file("before.ot") +
                   "\nrefine 2 20\nvoxel-map conventional\nexport-map " + file("conventional.ot") +
                   "\nexport-surface " + file("conventional.ply") + " map\nvoxel-map gibbs\n");
  user.run_quickly("export-map " + file("shown.ot") + "\nexport-map " + file("named.ot") +
                   " conventional\nexport-surface " + file("gibbs.ply") + " map\nexport " + file("whole") + "\n");
  EXPECT_EQ(read_file(file("conventional.ot")) == read_file(file("before.ot")), true);
  EXPECT_EQ(read_file(file("named.ot")) == read_file(file("before.ot")), true);
  EXPECT_EQ(read_file(file("shown.ot")) == read_file(folder_ / "whole" / "posterior.ot"), true);
  EXPECT_EQ(read_file(file("gibbs.ply")) == read_file(file("conventional.ply")), false);
}

// Views are planned on the Gibbs map; the conventional one is written all the same if it is shown.
TEST_F(WindowExport, TheSurfaceIsThatOfTheMapThatIsShownAlsoWhereViewsArePlannedOnTheOther) {
  Configuration configuration = small_scan();
  configuration.planner.gain = "gibbs";
  User user(configuration);
  user.run_quickly("step\nstep\nvoxel-map conventional\nexport-surface " + file("conventional.ply") +
                   " map\nvoxel-map gibbs\nexport-surface " + file("gibbs.ply") + " map\n");
  EXPECT_EQ(read_file(file("gibbs.ply")) == read_file(file("conventional.ply")), false);
}

TEST_F(WindowExport, TheSurfaceIsTheOneThatIsShown) {
  User user(small_scan());
  user.run_quickly("step\nstep\nexport-surface " + file("usual.ply") + "\nexport-surface " + file("map.ply") +
                   " map\nexport-surface " + file("cloud.ply") +
                   " cloud\ntoggle-surface\nsurface-of cloud\nexport-surface " + file("shown.ply") + "\n");
  EXPECT_EQ(read_file(file("usual.ply")) == read_file(file("map.ply")), true);
  EXPECT_EQ(read_file(file("shown.ply")) == read_file(file("cloud.ply")), true);
  EXPECT_EQ(read_file(file("cloud.ply")) == read_file(file("map.ply")), false);
}

TEST_F(WindowExport, WithoutAGibbsMapThereIsNoneToExport) {
  User user(small_scan());
  user.run_quickly("step\nexport-map " + file("none.ot") + " gibbs\n");
  EXPECT_FALSE(fs::exists(file("none.ot")));
  user.run_quickly("voxel-map gibbs\nexport-map " + file("shown.ot") + "\n");
  EXPECT_TRUE(fs::exists(file("shown.ot"))) << "the conventional one is shown as long as there is no other";
}

TEST_F(WindowExport, TheScenesPictureHasItsSizeAndLeavesTheWindowAsItWas) {
  User user(small_scan());
  user.run_quickly("step\nsave-picture " + file("before.png") + "\npalette\n");
  user.run_quickly("export-picture " + file("scene.png") + "\nexport-picture " + file("large.png") +
                   " 1600x900 transparent\nexport-curves " + file("curves.png") + " 700x500\n");
  user.run_quickly("palette\nsave-picture " + file("after.png") + "\n");
  const Rectangle scene = user.window().layout().scene;
  EXPECT_EQ(picture("scene.png").width, int(scene.width));
  EXPECT_EQ(picture("scene.png").height, int(scene.height));
  EXPECT_EQ(picture("large.png").width, 1600);
  EXPECT_EQ(picture("large.png").height, 900);
  EXPECT_EQ(picture("curves.png").width, 700);
  EXPECT_GT(transparent_pixels(picture("large.png")), 1600 * 900 / 3);
  EXPECT_EQ(transparent_pixels(picture("scene.png")), 0);
  EXPECT_EQ(picture("after.png"), picture("before.png"));
}

TEST_F(WindowExport, TheWindowsPictureHasAnySizeAndLeavesTheWindowAsItWas) {
  User user(small_scan());
  user.run_quickly("step\nsave-picture " + file("before.png") + "\n");
  user.run_quickly("save-picture " + file("large.png") + " 2000x1300\nsave-picture " + file("least.png") +
                   " 16x16\nsave-picture " + file("after.png") + "\n");
  const Image before = picture("before.png"), large = picture("large.png");
  EXPECT_EQ(large.width, 2000);
  EXPECT_EQ(large.height, 1300);
  EXPECT_EQ(picture("least.png").width, 16);
  EXPECT_EQ(picture("after.png"), before);
  User wide(small_scan(), 2000, 1300);
  wide.run_quickly("step\nsave-picture " + file("wide.png") + "\n");
  const Image in_such_a_window = picture("wide.png");
  const auto menus = std::size_t(large.width) * 4 * 30;
  EXPECT_TRUE(std::equal(large.rgba.begin(), large.rgba.begin() + std::ptrdiff_t(menus), in_such_a_window.rgba.begin()))
      << "the menu's pixels are those of a window of that size";
}

/// The picture is that part of the window, where no panel's notices lie on it, to the pixel.
TEST_F(WindowExport, TheScenesPictureIsWhatTheWindowShows) {
  User user(small_scan());
  user.run_quickly("step\nexport-picture " + file("scene.png") + "\nsave-picture " + file("window.png") + "\n");
  const Rectangle r = user.window().layout().scene;
  const Image scene = picture("scene.png"), window = picture("window.png");
  int different = 0;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const std::size_t in_scene = (std::size_t(y) * scene.width + x) * 4;
      const std::size_t in_window = (std::size_t(y + int(r.y)) * window.width + x + int(r.x)) * 4;
      different += !std::equal(&scene.rgba[in_scene], &scene.rgba[in_scene] + 3, &window.rgba[in_window]);
    }
  EXPECT_LT(different, scene.width * scene.height / 100) << "the selected view's frustum lies over the window's";
}

TEST_F(WindowExport, PicturesCarryTheConfigurationAndOpenWithIt) {
  User user(small_scan());
  user.run_quickly("step\nset termination.views 7\nexport-picture " + file("scene.png") + "\nsave-picture " +
                   file("window.png") + "\nexport-curves " + file("curves.png") + "\n");
  for (const char* name : {"scene.png", "window.png", "curves.png"}) {
    const Configuration carried = configuration_of(png_configuration(file(name)), file(name));
    EXPECT_EQ(to_toml(carried), to_toml(user.session().configuration)) << name;
  }
  user.run_quickly("set termination.views 3\nset map.resolution 0.04\nopen " + file("scene.png") + "\n");
  EXPECT_EQ(user.session().configuration.termination.views, 7);
  EXPECT_EQ(user.session().configuration.map.resolution, 0.02);
}

TEST_F(WindowExport, ATurntableGoesAllTheWayAroundAndCanBeCancelled) {
  User user(small_scan());
  user.run_quickly("step\nexport-picture " + file("start.png") + " 320x200\nexport-turntable " + file("turn") +
                   " 4 320x200\nexport-turntable " + file("half") + " 2 320x200\n");
  std::vector<Image> frames;
  for (int k = 1; k <= 4; ++k) frames.push_back(picture("turn/" + frame_name(k)));
  EXPECT_EQ(frames[0], picture("start.png"));
  for (int k = 0; k < 4; ++k) EXPECT_NE(frames[k], frames[(k + 1) % 4]) << k;
  EXPECT_EQ(frames[2], picture("half/" + frame_name(2))) << "the third of four is the second of two";
  EXPECT_FALSE(fs::exists(file("turn/" + frame_name(5))));

  user.window().run_script(parse_script("export-turntable " + file("long") + " 3000 64x48\n"));
  for (int k = 0; k < 20; ++k) user.window().draw(1.0 / 60);
  ASSERT_TRUE(user.window().state().picture.has_value());
  user.type(Key::escape);
  user.window().run_script(parse_script("cancel\n"));
  user.wait_for_news();
  EXPECT_FALSE(user.window().state().picture.has_value());
  EXPECT_LT(std::distance(fs::directory_iterator(file("long")), fs::directory_iterator()), 200);
}

TEST_F(WindowExport, WhatCannotBeWrittenIsToldAndTheWindowGoesOn) {
  User user(small_scan());
  std::vector<std::string> failures;
  user.window().script().set_on_failure([&](const ScriptFailure& f) { failures.push_back(f.reason); });
  fs::create_directories(folder_ / "mine");
  std::ofstream(folder_ / "mine" / "notes.txt") << "notes";
  user.run_quickly("export-cloud " + file("c.ply") + "\nstep\nexport-cloud " + file("c.xyz") + "\nexport-picture " +
                   file("p.jpg") + "\nexport-picture " + file("p.png") +
                   " huge\nexport-picture /proc/no.png\nexport-cloud " + "/proc/no.ply\nexport-turntable " +
                   file("mine") + "\nexport-curves " + file("c.svg") + "\n");
  ASSERT_EQ(failures.size(), 7u) << testing::PrintToString(failures);
  EXPECT_EQ(failures[0], "export-cloud: take a view first");
  EXPECT_THAT(failures[1], HasSubstr("c.xyz: a cloud can be written as .ply or .pcd"));
  EXPECT_THAT(failures[2], HasSubstr("p.jpg: a picture can be written as .png"));
  EXPECT_THAT(failures[3], HasSubstr("takes WIDTHxHEIGHT"));
  EXPECT_THAT(failures[4], HasSubstr("export-picture: /proc/no.png"));
  EXPECT_THAT(failures[5], HasSubstr("/proc/no.ply"));
  EXPECT_THAT(failures[6], HasSubstr("holds notes.txt"));
  EXPECT_EQ(read_file(folder_ / "mine" / "notes.txt"), "notes");
  EXPECT_TRUE(fs::exists(file("c.svg")));
  EXPECT_EQ(user.session().records.size(), 1u);
}

}  // namespace
}  // namespace nextview

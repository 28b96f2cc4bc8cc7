// The window for real: on a display (Xvfb), by a mouse and a keyboard (xdotool).
#include "tests/integration/display.hpp"

#include <algorithm>
#include <optional>

#include "tests/render/render_test.hpp"
#include "ui/panels/layout.hpp"

namespace nextview {
namespace {

TEST_F(Display, TheWindowStepsToTwentyViewsByClicks) {
  const Layout l(1280, 800, 1.0);
  start("window --termination.surface_left 0");
  ASSERT_TRUE(titled("view 0 of 20")) << "the window does not come up with the default object";
  for (int view = 1; view <= 20; ++view) {
    ASSERT_TRUE(click(50, l.control_bar.y + l.control_bar.height / 2));  // the Step button
    ASSERT_TRUE(titled(fmt::format("view {} of 20", view))) << "no step " << view;
  }
  xdotool("mousemove 640 785");                          // away from what would answer
  std::this_thread::sleep_for(std::chrono::seconds(9));  // notices go
  const PictureBound bound(0.03, 255, "the status line tells seconds, and a display has its own library versions");
  expect_screenshot("window", read_screen(folder_ / "Xvfb_screen0"), bound);
}

/// A pixel in the midst of the voxels: at their rim there may be others.
std::optional<Eigen::Vector2d> voxel_pixel(const Image& image, const Rectangle& r) {
  std::vector<Eigen::Vector2d> found;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int y = int(r.y); y < int(r.y + r.height); ++y)
    for (int x = int(r.x); x < int(r.x + r.width); ++x) {
      const std::uint8_t* p = &image.rgba[(std::size_t(y) * image.width + x) * 4];
      const bool occupied = p[2] > p[0] + 40 && p[2] > p[1] + 15, undecided = p[0] > p[2] + 70 && p[1] > p[2] + 35;
      if (!occupied && !undecided) continue;
      found.emplace_back(x, y);
      sum += found.back();
    }
  if (found.size() < 100) return std::nullopt;
  const Eigen::Vector2d middle = sum / double(found.size());
  return *std::min_element(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    return (a - middle).squaredNorm() < (b - middle).squaredNorm();
  });
}

TEST_F(Display, AScriptThatIsDoneEndsWithNought) {
  const std::string scan = (folder_ / "scan").string();
  EXPECT_EQ(play(fmt::format("step\nstep\nexport \"{0}\"\nquit\n", scan)), 0) << read_file(folder_ / "err");
  EXPECT_EQ(read_file(folder_ / "err").find("script.txt"), std::string::npos) << read_file(folder_ / "err");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "scan" / "surfaces.json")) << "it did not wait for the export";
}

TEST_F(Display, AScriptThatFailsGoesOnAndEndsWithTwo) {
  const std::string saved = (folder_ / "saved.txt").string(), err = (folder_ / "err").string();
  const std::string place = (folder_ / "script.txt").string();
  const std::string script =
      fmt::format("step\nexport /proc/no/such\nopen /no/such/file.ply\n\nstep\nsave-script {}\nquit\n", saved);
  EXPECT_EQ(play(script), 2);
  const std::string told = read_file(err);
  EXPECT_NE(told.find(place + ":2: export: "), std::string::npos) << told;
  EXPECT_NE(told.find(place + ":3: open: "), std::string::npos) << told;
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 2) << told;
  const std::string begin = "open sphere\nset sensor.width 160\nset sensor.height 120\nset termination.views 4\nstep\n";
  EXPECT_TRUE(read_file(saved).starts_with(begin)) << read_file(saved);
  std::filesystem::remove(saved);
  EXPECT_EQ(play(script, "--stop-on-error"), 2);
  EXPECT_EQ(read_file(err).find(":3:"), std::string::npos) << read_file(err);
  EXPECT_FALSE(std::filesystem::exists(saved)) << "it went on";
}

TEST_F(Display, AScriptOfAnObjectThatIsNotThereEndsWithTwo) {
  EXPECT_EQ(play("quit\n", "", "/no/such/file.ply"), 2);
  EXPECT_NE(read_file(folder_ / "err").find("/no/such/file.ply"), std::string::npos);
}

TEST_F(Display, AFileThatTheProgramIsStartedWithIsAmongTheRecentOnes) {
  const std::filesystem::path part = folder_ / "part.ply";
  std::filesystem::copy_file(NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply", part);
  start("'" + part.string() + "'");
  ASSERT_TRUE(titled("part - view 0"));
  EXPECT_EQ(read_file(folder_ / "nextview/recent"), part.string() + "\n");
}

class SmallDisplay : public Display {
 protected:
  std::string size() const override { return "640x480"; }
};

/// Whoever has no window manager gives no heed to the hints of a least size.
TEST_F(SmallDisplay, TheWindowWorksAndMayBeMadeSmaller) {
  start("window sphere --sensor.width 160 --sensor.height 120");
  ASSERT_TRUE(titled("sphere - view 0 of 20")) << "the window does not come up";
  const Layout l(640, 480, 1.0);
  ASSERT_TRUE(click(50, l.control_bar.y + l.control_bar.height / 2));  // the Step button
  ASSERT_TRUE(titled("view 1 of 20"));
  int views = 1;
  for (const char* smaller : {"400 300", "200 150", "90 60", "640 480"}) {
    ASSERT_TRUE(xdotool(fmt::format("search --name 'view . of 20' windowsize {}", smaller)));
    pause();
    ASSERT_TRUE(xdotool("mousemove 45 45"));
    ASSERT_TRUE(key("s"));
    ASSERT_TRUE(titled(fmt::format("view {} of 20", ++views))) << "at " << smaller;
  }
}

/// A voxel and a ray are inspected, a view is overridden, and the scan is stepped to its end; what was done is read
/// from the script that the window saves.
TEST_F(Display, AVoxelAndARayAreInspectedAndAViewIsOverridden) {
  const Layout l(1280, 800, 1.0);
  const double middle_x = l.scene.x + l.scene.width / 2, middle_y = l.scene.y + l.scene.height / 2;
  start("window --object.file sphere --sensor.width 320 --sensor.height 240 --termination.views 5");
  ASSERT_TRUE(titled("sphere - view 0 of 5"));
  ASSERT_TRUE(click(50, l.control_bar.y + l.control_bar.height / 2));  // the Step button
  ASSERT_TRUE(titled("view 1 of 5"));
  ASSERT_TRUE(xdotool(fmt::format("mousemove {:.0f} {:.0f}", middle_x, middle_y)));
  ASSERT_TRUE(key("s"));
  ASSERT_TRUE(titled("view 2 of 5"));
  pause();
  ASSERT_TRUE(key("4"));  // without frustums and rays, which are in front of the object
  ASSERT_TRUE(key("5"));
  pause();
  const Rectangle inner{l.scene.x + l.scene.width / 4, l.scene.y + l.scene.height / 4, l.scene.width / 2,
                        l.scene.height / 2};  // without the legend
  const auto voxel = voxel_pixel(read_screen(folder_ / "Xvfb_screen0"), inner);
  ASSERT_TRUE(voxel) << "no voxels are shown";
  ASSERT_TRUE(click(voxel->x(), voxel->y()));
  pause();
  ASSERT_TRUE(key("F5"));  // the View panel
  pause();
  ASSERT_TRUE(click(l.right.x + 100, l.right.y + 460));  // what the rays contribute
  pause();
  ASSERT_TRUE(key("F4"));  // the candidates
  pause();
  ASSERT_TRUE(click(l.right.x + 100, l.right.y + l.right.height / 2));  // one of them
  pause();
  ASSERT_TRUE(key("t"));
  pause();
  for (int view = 3; view <= 5; ++view) {
    ASSERT_TRUE(key("s"));
    ASSERT_TRUE(titled(fmt::format("view {} of 5", view)));
    pause();
  }
  const std::filesystem::path file = folder_ / "script.txt";
  ASSERT_TRUE(key("ctrl+p"));
  pause();
  ASSERT_TRUE(xdotool(fmt::format("type --delay 30 'save-script {}'", file.string())));
  ASSERT_TRUE(key("Return"));
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(file); })) << "no script was saved by the palette";
  const std::string script = read_file(file);
  EXPECT_EQ(count_lines(script, "step"), 5) << script;
  EXPECT_EQ(count_lines(script, "inspect-voxel"), 1) << script;
  EXPECT_EQ(count_lines(script, "inspect-ray"), 1) << script;
  EXPECT_EQ(count_lines(script, "select-view"), 1) << script;
  EXPECT_EQ(count_lines(script, "take-view"), 1) << script;
  const auto select = script.find("select-view"), take = script.find("take-view");
  EXPECT_LT(select, take) << script;
  EXPECT_LT(take, script.rfind("step")) << script;
}

}  // namespace
}  // namespace nextview

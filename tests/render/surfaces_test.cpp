#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/render/picture_comparison.hpp"
#include "tests/render/virtual_display.hpp"
#include "tests/render/window_picture.hpp"
#include "ui/render_target/headless.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

TEST(Surfaces, DrawHeadlessHere) {
  EXPECT_TRUE(drawing_headless());
  EXPECT_EQ(std::getenv("LD_PRELOAD"), nullptr) << "children must not inherit the preloading";
}

TEST(Surfaces, WindowAndImageAreEqualToTheByte) {
  const VirtualDisplay display;
  ASSERT_TRUE(display.ready()) << "Xvfb does not start; install xvfb";
  const auto self = std::filesystem::read_symlink("/proc/self/exe").string();
  const auto png = std::filesystem::temp_directory_path() / ("nextview-window-" + std::to_string(::getpid()) + ".png");
  ASSERT_EQ(exit_status(start({"env", "DISPLAY=" + display.name(), self, "--draw-in-window", png.string()})), 0);
  const Image window = read_png(png);
  std::filesystem::remove(png);

  OffscreenTarget target(window.width, window.height);
  const Image image = draw_everything(target);
  EXPECT_EQ(image, window) << compare(window, image).summary();
}

TEST(Surfaces, ASceneDoesNotDependOnWhatWasDrawnBefore) {
  OffscreenTarget first(960, 600);
  const Image once = draw_everything(first);
  OffscreenTarget second(960, 600);
  const Image other = draw_everything(second);
  EXPECT_EQ(once, other);
  EXPECT_EQ(draw_everything(first), once) << "drawn again while another surface lives";
}

TEST(Surfaces, AWindowWithoutADisplaySaysSo) {
  const auto self = std::filesystem::read_symlink("/proc/self/exe").string();
  testing::internal::CaptureStderr();
  const int status =
      exit_status(start({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", self, "--draw-in-window", "x.png"}));
  const std::string error = testing::internal::GetCapturedStderr();
  EXPECT_EQ(status, 2);
  EXPECT_NE(error.find("cannot open a window"), std::string::npos) << error;
}

TEST(Surfaces, AMissingHeadlessLibrarySaysSo) {
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  const auto folder = std::filesystem::temp_directory_path() / ("nextview-alone-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(self, folder / "alone");
  testing::internal::CaptureStderr();
  const int status = exit_status(start({(folder / "alone").string()}));
  const std::string error = testing::internal::GetCapturedStderr();
  std::filesystem::remove_all(folder);
  EXPECT_EQ(status, 2);
  EXPECT_NE(error.find("libnextview_headless_gl.so: No such file"), std::string::npos) << error;
}

}  // namespace
}  // namespace nextview

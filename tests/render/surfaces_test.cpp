#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/render/picture_comparison.hpp"
#include "tests/render/window_picture.hpp"
#include "ui/render_target/headless.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

pid_t start(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t process = 0;
  if (::posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return -1;
  return process;
}

int exit_status(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// An X server without a screen, on a display that is free.
class VirtualDisplay {
 public:
  VirtualDisplay() {
    int ends[2];
    if (::pipe(ends) != 0) return;
    server_ =
        start({"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"});
    ::close(ends[1]);
    char c = 0;
    while (::read(ends[0], &c, 1) == 1 && c != '\n') name_ += c;  // ends when the server is ready, or has ended
    ::close(ends[0]);
  }
  ~VirtualDisplay() {
    if (server_ <= 0) return;
    ::kill(server_, SIGTERM);
    exit_status(server_);
  }

  bool ready() const { return server_ > 0 && !name_.empty(); }
  std::string name() const { return ":" + name_; }

 private:
  pid_t server_ = -1;
  std::string name_;
};

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

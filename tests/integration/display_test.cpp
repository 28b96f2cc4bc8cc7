// The window for real: on a display (Xvfb), by a mouse (xdotool), from the first view to the twentieth.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "core/file/atomic_file.hpp"
#include "tests/render/render_test.hpp"

namespace nextview {
namespace {

/// A program in the background; ends with the test.
class Background {
 public:
  explicit Background(const std::string& command) : pipe_(popen(("echo $$; exec " + command).c_str(), "r")) {
    pid_ = std::stoi(line());
  }
  ~Background() {
    kill(pid_, SIGTERM);
    pclose(pipe_);
  }
  /// The next line that it prints; empty if it ended instead.
  std::string line() {
    std::array<char, 256> text{};
    if (!std::fgets(text.data(), text.size(), pipe_)) return "";
    text[std::strcspn(text.data(), "\n")] = '\0';
    return text.data();
  }

 private:
  FILE* pipe_;
  pid_t pid_ = 0;
};

/// What Xvfb keeps of its screen in a file: the X window dump format, 32 bits a pixel.
Image read_screen(const std::filesystem::path& file) {
  const std::string dump = read_file(file);
  const auto number = [&](std::size_t i) {
    std::uint32_t value = 0;
    for (std::size_t b = 0; b < 4; ++b) value = value << 8 | static_cast<unsigned char>(dump.at(4 * i + b));
    return value;
  };
  const std::size_t header = number(0), colours = number(19), stride = number(12);
  Image image{static_cast<int>(number(4)), static_cast<int>(number(5)), {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::size_t pixel = header + 12 * colours + y * stride + 4 * std::size_t(x);
      for (const std::size_t channel : {2, 1, 0})  // blue, green, red
        image.rgba.push_back(static_cast<std::uint8_t>(dump.at(pixel + channel)));
      image.rgba.push_back(255);
    }
  return image;
}

TEST(Display, TheWindowStepsToTwentyViewsByClicks) {
  std::string name = (std::filesystem::temp_directory_path() / "nextview-display-XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  const std::filesystem::path folder = name;
  {
    Background server(fmt::format("Xvfb -displayfd 1 -screen 0 1280x800x24 -fbdir {} -nolisten tcp 2>/dev/null", name));
    const std::string display = ":" + server.line();
    ASSERT_NE(display, ":") << "Xvfb does not start; install xvfb";
    const Background program(fmt::format("env DISPLAY={} '{}' 2>/dev/null", display, NEXTVIEW_PROGRAM));
    const auto xdotool = [&](const std::string& words) {
      return std::system(fmt::format("DISPLAY={} timeout 60 xdotool {} >/dev/null 2>&1", display, words).c_str()) == 0;
    };
    const auto titled = [&](const std::string& title) {
      for (int tenths = 0; tenths < 1200; ++tenths) {
        if (xdotool(fmt::format("search --name '{}'", title))) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      }
      return false;
    };
    ASSERT_TRUE(titled("view 0 of 20")) << "the window does not come up with the default object";
    for (int view = 1; view <= 20; ++view) {
      ASSERT_TRUE(xdotool("mousemove 50 28 click 1"));  // the Step button
      ASSERT_TRUE(titled(fmt::format("view {} of 20", view))) << "no step " << view;
    }
    xdotool("mousemove 640 785");  // away from what would answer
    std::this_thread::sleep_for(std::chrono::seconds(2));
    const PictureBound bound(0.03, 255, "the status line tells seconds, and a display has its own library versions");
    expect_screenshot("window", read_screen(folder / "Xvfb_screen0"), bound);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace nextview

#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "core/file/atomic_file.hpp"
#include "core/file/own_folder.hpp"
#include "core/file/read_file.hpp"
#include "ui/render_target/image.hpp"

namespace nextview {

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
  /// As a crash does.
  void kill_now() const { kill(pid_, SIGKILL); }
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

/// What Xvfb keeps of its screen in a file: the X window dump format, 32 bits per pixel.
inline Image read_screen(const std::filesystem::path& file) {
  const std::string dump = read_file(file);
  const auto number = [&](std::size_t i) {
    std::uint32_t value = 0;
    for (std::size_t b = 0; b < 4; ++b) value = value << 8 | static_cast<unsigned char>(dump.at(4 * i + b));
    return value;
  };
  const std::size_t header = number(0), colours = number(19), stride = number(12);
  Image image{static_cast<int>(number(4)), static_cast<int>(number(5)), {}};
  const std::size_t row = std::size_t(image.width) * 4;
  image.rgba.resize(row * std::size_t(image.height), 255);
  for (std::size_t y = 0; y < std::size_t(image.height); ++y) {
    const std::size_t begin = header + 12 * colours + y * stride;
    if (begin + row > dump.size()) throw std::runtime_error(file.string() + ": is cut off");
    for (std::size_t x = 0; x < row; x += 4)
      for (std::size_t channel = 0; channel < 3; ++channel)  // they are blue, green, red there
        image.rgba[y * row + x + channel] = static_cast<std::uint8_t>(dump[begin + x + 2 - channel]);
  }
  return image;
}

/// The program in front of somebody with a mouse and a keyboard.
class Display : public testing::Test {
 protected:
  virtual std::string size() const { return "1280x800"; }  ///< of the display [px]
  void SetUp() override {
    folder_ = make_own_folder("nextview-display-");
    // A server that begins anew when its last client leaves would turn away whoever comes at that moment.
    server_ = std::make_unique<Background>(fmt::format(
        "Xvfb -displayfd 1 -noreset -screen 0 {}x24 -fbdir {} -nolisten tcp 2>/dev/null", size(), folder_.string()));
    display_ = ":" + server_->line();
    ASSERT_NE(display_, ":") << "Xvfb does not start; install xvfb";
  }
  void TearDown() override {
    program_.reset();
    server_.reset();
    std::filesystem::remove_all(folder_);
  }
  void start(const std::string& arguments = "") {
    program_ = std::make_unique<Background>(fmt::format("env XDG_STATE_HOME='{}' DISPLAY={} '{}' {} 2>/dev/null",
                                                        folder_.string(), display_, NEXTVIEW_PROGRAM, arguments));
  }

  /// Plays a script in the window until the program ends; returns its exit code, or 128 and more if it was killed.
  int play(const std::string& script, const std::string& options = "", const std::string& object = "sphere") const {
    write_file(folder_ / "script.txt", script);
    const std::string command = fmt::format(
        "XDG_STATE_HOME='{2}' DISPLAY={0} timeout 240 '{1}' window {4} --sensor.width 160 --sensor.height 120 "
        "--termination.views 4 --script '{2}/script.txt' {3} >'{2}/out' 2>'{2}/err'",
        display_, NEXTVIEW_PROGRAM, folder_.string(), options, object);
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  bool xdotool(const std::string& words) const {
    return std::system(fmt::format("DISPLAY={} timeout 60 xdotool {} >/dev/null 2>&1", display_, words).c_str()) == 0;
  }
  bool click(double x, double y) const { return xdotool(fmt::format("mousemove {:.0f} {:.0f} click 1", x, y)); }
  bool key(const std::string& name) const { return xdotool("key " + name); }
  /// Waits until `good` for two minutes at most.
  template <class Predicate>
  static bool wait_until(Predicate good) {
    for (int tenths = 0; tenths < 1200; ++tenths) {
      if (good()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }
  /// Likewise, until a window has this title. xdotool looks for it twice a second by itself: to start it for each look
  /// took longer than what was waited for.
  bool titled(const std::string& title) const {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::minutes(2);
    do {
      if (xdotool(fmt::format("search --sync --name '{}'", title))) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    } while (Clock::now() < end);
    return false;
  }
  static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(1500)); }

  std::filesystem::path folder_;
  std::string display_;
  std::unique_ptr<Background> server_, program_;
};

/// How many of the lines begin with this word.
inline int count_lines(const std::string& script, const std::string& word) {
  int count = 0;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) count += line == word || line.starts_with(word + " ");
  return count;
}

}  // namespace nextview

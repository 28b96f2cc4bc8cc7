#include "ui/demo/demo_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <semaphore>
#include <stdexcept>

#include "core/export/frame_folder.hpp"
#include "core/file/atomic_file.hpp"
#include "core/progress/stopped.hpp"
#include "ui/commands/command_list.hpp"
#include "ui/render_target/offscreen_target.hpp"
#include "ui/window/interface.hpp"

namespace nextview {
namespace {

constexpr int longest_demo = 3600;  // [s]

/// Frames of any size look alike.
double scale_of(const PictureSize& size) { return std::min(size.width / 1280.0, size.height / 720.0); }

/// The window, whose time is given to it, and what it works with.
class DemoWindow {
 public:
  DemoWindow(const Demo& demo, RenderTarget& target)
      : target_(target),
        worker_([this] { news_.release(); }),
        inspector_([this] { news_.release(); }),
        interface_(target, worker_, inspector_, scale_of({target.width(), target.height()})) {
    interface_.script().set_on_failure([this, file = demo.file](const ScriptFailure& failure) {
      if (!failure_) failure_ = fmt::format("{}:{}: {}", file.string(), failure.line, failure.reason);
    });
    interface_.play_demo(demo.calls);
  }

  bool is_done() const { return interface_.script_is_done(); }
  /// The next frame, `seconds` after the last one: drawn once nothing runs any more and no line is left to do.
  Image frame(double seconds, const std::stop_token& stop) {
    bool is_new = interface_.draw(seconds);
    while (!interface_.is_still()) {
      throw_if_stopped(stop);
      if (interface_.seconds_to_next_frame() > 0.0)
        static_cast<void>(news_.try_acquire_for(std::chrono::milliseconds(5)));
      else
        is_new |= interface_.draw(0.0);
      if (failure_) throw std::runtime_error(*failure_);
    }
    if (is_new || last_.rgba.empty()) last_ = target_.read_back();
    return last_;
  }
  Configuration configuration() { return worker_.snapshot()->configuration; }

 private:
  std::counting_semaphore<> news_{0};
  RenderTarget& target_;
  SessionWorker worker_;
  InspectionWorker inspector_;
  Interface interface_;
  std::optional<std::string> failure_;
  Image last_;  ///< what stands still need not be read again
};

}  // namespace

Configuration play_demo(const Demo& demo, const DemoPictures& pictures,
                        const std::function<void(const Image&, int number)>& take, const std::stop_token& stop) {
  OffscreenTarget target(pictures.size.width, pictures.size.height);
  return play_demo(demo, target, pictures.frames_per_second, take, stop);
}

Configuration play_demo(const Demo& demo, RenderTarget& target, int frames_per_second,
                        const std::function<void(const Image&, int number)>& take, const std::stop_token& stop) {
  Demo whole = demo;
  whole.calls.push_back(find_command("wait").read({}));  // for what the last line began
  whole.calls.back().line = demo.calls.back().line;
  DemoWindow window(whole, target);
  Image frame = window.frame(0.0, stop);
  for (int number = 1; number == 1 || !window.is_done(); ++number) {
    if (number > longest_demo * frames_per_second)
      throw std::runtime_error(fmt::format("{}: takes longer than an hour", demo.file.string()));
    take(frame, number);
    frame = window.frame(1.0 / frames_per_second, stop);
  }
  return window.configuration();
}

int write_demo(const Demo& demo, const DemoPictures& pictures, OutputFolder& folder,
               const std::function<void(int number)>& progress, const std::stop_token& stop) {
  int count = 0;
  Image last;
  const auto write = [&](const Image& image, int number) {
    progress(number);
    const std::filesystem::path file = folder.claim(frame_name(number));
    // What stands still need not be compressed again.
    if (image == last)
      write_file(file, read_file(folder.path() / frame_name(number - 1)));
    else
      write_png(image, file);
    last = image;
    count = number;
  };
  const Configuration configuration = play_demo(demo, pictures, write, stop);
  write_file(folder.claim("config.toml"), to_toml(configuration, folder.path()));
  return count;
}

}  // namespace nextview
